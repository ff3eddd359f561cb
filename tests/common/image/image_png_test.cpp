// PNG: every 8-bit value is kept, other programs' files are read right, bad ones are refused.
#include <png.h>

#include <algorithm>
#include <cstdio>

#include "common/image/srgb.h"
#include "tests/common/image/image_testing.h"

namespace relief {
namespace {

using test::failure;
using test::ScratchFolder;
using test::slurp;
using test::spill;

TEST(Png, KeepsEvery8BitValueExactly) {
  const ScratchFolder folder;
  Image image{256, 1, {}};
  for (const char* name : {"R", "G", "B"}) {
    Channel channel{name, ChannelType::Half, {}};
    for (int v = 0; v < 256; ++v) {
      const int value = name[0] == 'G' ? 255 - v : v;
      channel.values.push_back(linear_from_srgb(static_cast<float>(value) / 255.0F));
    }
    image.channels.push_back(channel);
  }
  ASSERT_TRUE(write_png(folder / "a.png", image));

  // Read by libpng, without our reader.
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&png, (folder / "a.png").c_str()), 0);
  EXPECT_EQ(png.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  std::vector<std::uint8_t> samples(std::size_t{256} * 3);
  ASSERT_NE(png_image_finish_read(&png, nullptr, samples.data(), 0, nullptr), 0);
  for (std::size_t v = 0; v < 256; ++v) {
    EXPECT_EQ(samples[3 * v], v);
    EXPECT_EQ(samples[3 * v + 1], 255 - v);
  }

  const auto back = read_image(folder / "a.png");
  ASSERT_TRUE(back) << back.error().message;
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(back->channels[c].values, image.channels[c].values);
}

TEST(Png, DividesByAlphaAndWritesItOnlyIfNeeded) {
  const ScratchFolder folder;
  const float linear = linear_from_srgb(200.0F / 255.0F);
  const float half_alpha = 128.0F / 255.0F;
  Image image{4, 1, {}};
  for (const char* name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Half, {linear * half_alpha, 2.0F, 0.0F, -1.0F}});
  }
  image.channels.push_back({"A", ChannelType::Half, {half_alpha, 1.0F, 0.0F, 1.0F}});
  ASSERT_TRUE(write_png(folder / "a.png", image));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&png, (folder / "a.png").c_str()), 0);
  EXPECT_EQ(png.format, static_cast<png_uint_32>(PNG_FORMAT_RGBA));
  std::vector<std::uint8_t> samples(16);
  ASSERT_NE(png_image_finish_read(&png, nullptr, samples.data(), 0, nullptr), 0);
  EXPECT_EQ(samples, (std::vector<std::uint8_t>{200, 200, 200, 128, 255, 255, 255, 255, 0, 0, 0, 0,
                                                0, 0, 0, 255}));
  const auto back = read_image(folder / "a.png");
  ASSERT_TRUE(back);
  ASSERT_EQ(back->channels.size(), 4U);
  // One product in single precision either way.
  EXPECT_NEAR(back->channels[0].values[0], linear * half_alpha, 1e-6F);

  image.channels[3].values.assign(4, 1.0F);
  ASSERT_TRUE(write_png(folder / "b.png", image));
  png_image opaque{};
  opaque.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_file(&opaque, (folder / "b.png").c_str()), 0);
  EXPECT_EQ(opaque.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  png_image_free(&opaque);
}

TEST(Png, NeedsColour) {
  const ScratchFolder folder;
  const Image image{1, 1, {{"Z", ChannelType::Float, {1.0F}}}};
  const Status written = write_png(folder / "a.png", image);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("R, G and B"), std::string::npos);
  EXPECT_EQ(folder.count(), 0);
}

/// Writes a 4 x 2 image by libpng's detailed interface.
void write_foreign_png(const std::filesystem::path& path, int bits, int colour_type,
                       int interlace) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, 4, 2, bits, colour_type, interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_color palette[16];
  for (int k = 0; k < 16; ++k) palette[k] = {static_cast<png_byte>(16 * k), 0, 255};
  if (colour_type == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 16);
  png_write_info(png, info);
  std::vector<png_byte> row(32);  // 4 pixels of 4 samples of 2 bytes at most
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = static_cast<png_byte>(0x21 + 8 * k);
  png_bytep rows[2] = {row.data(), row.data()};
  png_write_image(png, rows);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

TEST(Png, ReadsEveryKind) {
  const ScratchFolder folder;
  struct Kind {
    int bits;
    int colour_type;
    std::size_t channels;
    float red;  ///< of the first pixel, as sRGB in [0, 1]
  };
  // The first bytes of a row are 0x21 0x29 0x31 0x39.
  const Kind kinds[] = {
      {8, PNG_COLOR_TYPE_RGB, 3, 0x21 / 255.0F},
      {8, PNG_COLOR_TYPE_RGB_ALPHA, 4, 0x21 / 255.0F},
      {8, PNG_COLOR_TYPE_GRAY, 3, 0x21 / 255.0F},
      {8, PNG_COLOR_TYPE_GRAY_ALPHA, 4, 0x21 / 255.0F},
      {16, PNG_COLOR_TYPE_RGB, 3, 0x2129 / 65535.0F},
      {16, PNG_COLOR_TYPE_RGB_ALPHA, 4, 0x2129 / 65535.0F},
      {16, PNG_COLOR_TYPE_GRAY, 3, 0x2129 / 65535.0F},
      {4, PNG_COLOR_TYPE_GRAY, 3, 2 / 15.0F},
      {1, PNG_COLOR_TYPE_GRAY, 3, 0.0F},
      {4, PNG_COLOR_TYPE_PALETTE, 3, 2 * 16 / 255.0F},
  };
  const float alphas[] = {0x39 / 255.0F, 0x29 / 255.0F};
  for (const Kind& kind : kinds) {
    for (const int interlace : {PNG_INTERLACE_NONE, PNG_INTERLACE_ADAM7}) {
      SCOPED_TRACE(testing::Message() << kind.bits << " bits, type " << kind.colour_type);
      write_foreign_png(folder / "a.png", kind.bits, kind.colour_type, interlace);
      const auto image = read_image(folder / "a.png");
      ASSERT_TRUE(image) << image.error().message;
      EXPECT_EQ(image->width, 4U);
      EXPECT_EQ(image->height, 2U);
      ASSERT_EQ(image->channels.size(), kind.channels);
      float alpha = 1.0F;
      if (kind.channels == 4) {
        alpha = kind.bits == 16 ? 0x5159 / 65535.0F
                                : alphas[kind.colour_type == PNG_COLOR_TYPE_GRAY_ALPHA ? 1 : 0];
        EXPECT_EQ(image->channels[3].values[0], alpha);
      }
      EXPECT_EQ(image->channels[0].values[0], alpha * linear_from_srgb(kind.red));
      EXPECT_EQ(image->channels[0].values[4], image->channels[0].values[0]);  // the second row
    }
  }
}

TEST(Png, RefusesEveryTruncationAndEveryFlip) {
  const ScratchFolder folder;
  write_foreign_png(folder / "a.png", 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE);
  const std::string bytes = slurp(folder / "a.png");
  const auto whole = read_image(folder / "a.png");
  ASSERT_TRUE(whole);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    spill(folder / "b.png", bytes.substr(0, length));
    EXPECT_NE(failure(folder / "b.png"), "") << length;
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x41);
    spill(folder / "b.png", flipped);
    const auto image = read_image(folder / "b.png");
    // A checksum protects each chunk; only IEND's own may be passed over.
    if (!image) continue;
    EXPECT_EQ(image->channels[1].values, whole->channels[1].values) << at;
  }
}

}  // namespace
}  // namespace relief

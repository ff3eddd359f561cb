// Pictures: what is written is read again, other programs' files are read right, bad ones are
// refused in a sentence.
#include "common/image_io.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "common/srgb.h"
#include "tests/common/sample_models.h"

namespace relief {
namespace {

using test::ScratchFolder;
using test::slurp;
using test::spill;

Channel make_channel(const char* name, ChannelType type, std::size_t count, float scale) {
  Channel channel{name, type, {}};
  for (std::size_t k = 0; k < count; ++k) {
    channel.values.push_back(scale * std::round(100.0F * std::sin(static_cast<float>(k) * 0.37F)));
  }
  return channel;
}

/// A channel's values; none if there is no such channel.
std::vector<float> values_of(const Image& image, const char* channel) {
  const Channel* found = image.find(channel);
  return found != nullptr ? found->values : std::vector<float>();
}

/// The message of what must fail; it starts with the file's name and is one sentence.
std::string failure(const std::filesystem::path& path) {
  const auto image = read_image(path);
  EXPECT_FALSE(image);
  if (image) return {};
  EXPECT_EQ(image.error().message.find(path.string()), 0U) << image.error().message;
  EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
  return image.error().message.substr(path.string().size());
}

TEST(Exr, KeepsEveryChannelInItsType) {
  const ScratchFolder folder;
  Image image{7, 5, {}};
  image.channels.push_back(make_channel("R", ChannelType::Half, 35, 0.25F));
  image.channels.push_back(make_channel("Z", ChannelType::Float, 35, 1.0F / 3.0F));
  image.channels.push_back(make_channel("N.X", ChannelType::Half, 35, 0.5F));
  image.channels.push_back(make_channel("patch", ChannelType::Uint, 35, 1.0F));
  for (float& v : image.channels[3].values) v = std::abs(v) * 1000.0F;
  image.channels[1].values[3] = std::numeric_limits<float>::infinity();
  ASSERT_TRUE(write_exr(folder / "a.exr", image));
  const auto back = read_image(folder / "a.exr");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->width, 7U);
  EXPECT_EQ(back->height, 5U);
  ASSERT_EQ(back->channels.size(), 4U);
  for (const Channel& channel : image.channels) {
    const Channel* found = back->find(channel.name);
    ASSERT_NE(found, nullptr) << channel.name;
    EXPECT_EQ(found->type, channel.type);
    EXPECT_EQ(found->values, channel.values) << channel.name;
  }
}

TEST(Exr, KeepsFiniteHalvesFinite) {
  const ScratchFolder folder;
  const float infinity = std::numeric_limits<float>::infinity();
  Image image{4, 1, {{"R", ChannelType::Half, {1e6F, -1e6F, infinity, 65504.0F}}}};
  ASSERT_TRUE(write_exr(folder / "a.exr", image));
  const auto back = read_image(folder / "a.exr");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->channels[0].values,
            (std::vector<float>{65504.0F, -65504.0F, infinity, 65504.0F}));
}

TEST(Exr, GivesTheSameBytesEachTime) {
  const ScratchFolder folder;
  Image image{200, 90, {make_channel("R", ChannelType::Half, 18000, 0.01F)}};
  ASSERT_TRUE(write_exr(folder / "a.exr", image));
  ASSERT_TRUE(write_exr(folder / "b.exr", image));
  EXPECT_EQ(slurp(folder / "a.exr"), slurp(folder / "b.exr"));
}

/// Writes one channel G of 64 x 32 with a data window that does not start at the origin.
void write_foreign_exr(const std::filesystem::path& path, Imf::Compression compression, bool tiled,
                       const std::vector<float>& values) {
  const Imath::Box2i window({-10, 5}, {53, 36});
  Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
  header.compression() = compression;
  header.channels().insert("G", Imf::Channel(Imf::FLOAT));
  Imf::FrameBuffer frame;
  frame.insert("G", Imf::Slice::Make(Imf::FLOAT, values.data(), window));
  if (tiled) {
    header.setTileDescription(Imf::TileDescription(24, 20, Imf::ONE_LEVEL));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(32);
  }
}

TEST(Exr, ReadsEveryCompressionScannedAndTiled) {
  const ScratchFolder folder;
  std::vector<float> values;
  values.reserve(2048);
  for (int k = 0; k < 2048; ++k)
    values.push_back(1.0F + 0.5F * std::sin(0.1F * static_cast<float>(k % 64)));
  for (const auto compression :
       {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
        Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
        Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
    for (const bool tiled : {false, true}) {
      SCOPED_TRACE(testing::Message() << "compression " << compression << " tiled " << tiled);
      write_foreign_exr(folder / "a.exr", compression, tiled, values);
      const auto image = read_image(folder / "a.exr");
      ASSERT_TRUE(image) << image.error().message;
      EXPECT_EQ(image->width, 64U);
      EXPECT_EQ(image->height, 32U);
      ASSERT_EQ(image->channels.size(), 1U);
      for (std::size_t k = 0; k < values.size(); ++k) {
        // DWA is lossy, by about 1 % at its default level; PXR24 keeps 24 bits.
        ASSERT_NEAR(image->channels[0].values[k], values[k], 0.02F) << k;
      }
    }
  }
}

/// A small valid EXR whose data window is then overwritten in the bytes.
std::string exr_with_window(const ScratchFolder& folder, std::int32_t right, std::int32_t bottom) {
  Image image{2, 2, {make_channel("R", ChannelType::Half, 4, 1.0F)}};
  EXPECT_TRUE(write_exr(folder / "small.exr", image));
  std::string bytes = slurp(folder / "small.exr");
  const std::size_t at =
      bytes.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4 + 8;
  std::memcpy(bytes.data() + at, &right, 4);
  std::memcpy(bytes.data() + at + 4, &bottom, 4);
  return bytes;
}

TEST(Exr, RefusesHostileSizes) {
  const ScratchFolder folder;
  spill(folder / "a.exr", exr_with_window(folder, 1, 1));
  EXPECT_TRUE(read_image(folder / "a.exr"));  // the offset within the bytes is right
  for (const auto& [right, bottom] : {std::pair{2147483646, 1},
                                      {1, 2147483646},
                                      {65535, 65535},
                                      {70000, 1},
                                      {-5, 1},
                                      {2147483646, 2147483646}}) {
    spill(folder / "a.exr", exr_with_window(folder, right, bottom));
    EXPECT_NE(failure(folder / "a.exr"), "") << right << " " << bottom;
  }
}

TEST(Exr, RefusesEveryTruncationAndSurvivesEveryFlip) {
  const ScratchFolder folder;
  const std::string bytes = exr_with_window(folder, 1, 1);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    spill(folder / "a.exr", bytes.substr(0, length));
    EXPECT_NE(failure(folder / "a.exr"), "") << length;
  }
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x81);
    spill(folder / "a.exr", flipped);
    static_cast<void>(read_image(folder / "a.exr"));  // EXR has no checksum: only no crash
  }
}

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

  // Read by libpng alone.
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

/// Writes a 4 x 2 picture by libpng's detailed interface.
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

/// A Radiance file with the usual header and these bytes behind it.
std::string radiance(const std::string& resolution, const std::vector<int>& pixels) {
  std::string bytes =
      "#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n" + resolution + "\n";
  for (const int byte : pixels) bytes.push_back(static_cast<char>(byte));
  return bytes;
}

TEST(Radiance, ReadsFlatPixels) {
  const ScratchFolder folder;
  spill(folder / "a.hdr", radiance("-Y 1 +X 2", {128, 64, 32, 129, 255, 0, 1, 136}));
  const auto image = read_image(folder / "a.hdr");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 2U);
  EXPECT_EQ(image->height, 1U);
  EXPECT_EQ(values_of(*image, "R"), (std::vector<float>{1.0F, 255.0F}));
  EXPECT_EQ(values_of(*image, "G"), (std::vector<float>{0.5F, 0.0F}));
  EXPECT_EQ(values_of(*image, "B"), (std::vector<float>{0.25F, 1.0F}));
}

TEST(Radiance, ReadsOldRuns) {
  const ScratchFolder folder;
  // One pixel, two more of it, and 256 of it by a second count; then another pixel.
  spill(folder / "a.hdr",
        radiance("-Y 1 +X 260", {9, 8, 7, 136, 1, 1, 1, 2, 1, 1, 1, 1, 5, 5, 5, 136}));
  const auto image = read_image(folder / "a.hdr");
  ASSERT_TRUE(image) << image.error().message;
  for (int x = 0; x < 259; ++x) EXPECT_EQ(values_of(*image, "B")[x], 7.0F);
  EXPECT_EQ(values_of(*image, "B")[259], 5.0F);
}

TEST(Radiance, ReadsNewRuns) {
  const ScratchFolder folder;
  std::vector<int> bytes;
  for (int y = 0; y < 2; ++y) {
    for (const int b : {2, 2, 0, 9}) bytes.push_back(b);
    for (const int b : {128 + 9, 10 + y}) bytes.push_back(b);               // R: one run
    for (const int b : {9, 1, 2, 3, 4, 5, 6, 7, 8, 9}) bytes.push_back(b);  // G: no run
    for (const int b : {3, 1, 2, 3, 128 + 6, 20}) bytes.push_back(b);       // B: both
    for (const int b : {128 + 9, 136}) bytes.push_back(b);
  }
  spill(folder / "a.hdr", radiance("-Y 2 +X 9", bytes));
  const auto image = read_image(folder / "a.hdr");
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(values_of(*image, "R")[8], 10.0F);
  EXPECT_EQ(values_of(*image, "R")[9], 11.0F);
  EXPECT_EQ(values_of(*image, "G")[17], 9.0F);
  EXPECT_EQ(values_of(*image, "B")[2], 3.0F);
  EXPECT_EQ(values_of(*image, "B")[8], 20.0F);

  const std::string whole = radiance("-Y 2 +X 9", bytes);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    spill(folder / "b.hdr", whole.substr(0, length));
    EXPECT_NE(failure(folder / "b.hdr"), "") << length;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string flipped = whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x85);
    spill(folder / "b.hdr", flipped);
    static_cast<void>(read_image(folder / "b.hdr"));  // no checksum: only no crash
  }
}

TEST(Radiance, SaysWhatItDoesNotRead) {
  const ScratchFolder folder;
  spill(folder / "a.hdr", radiance("+Y 1 +X 1", {1, 2, 3, 4}));
  EXPECT_NE(failure(folder / "a.hdr").find("'+Y 1 +X 1'"), std::string::npos);
  spill(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd");
  EXPECT_NE(failure(folder / "a.hdr").find("32-bit_rle_xyze"), std::string::npos);
  for (const char* size :
       {"-Y 99999999 +X 99999999", "-Y -1 +X 4", "-Y 0 +X 4", "-Y 4 +X 0", "-Y 65536 +X 65536",
        "-Y 30000 +X 10000", "-Y 99999999999999999999 +X 1"}) {
    spill(folder / "a.hdr", radiance(size, {1, 2, 3, 4}));
    EXPECT_NE(failure(folder / "a.hdr"), "") << size;
  }
  // Runs that leave the picture, or that repeat a pixel that is not there.
  spill(folder / "a.hdr", radiance("-Y 1 +X 4", {9, 8, 7, 136, 1, 1, 1, 200}));
  EXPECT_NE(failure(folder / "a.hdr").find("scanline"), std::string::npos);
  spill(folder / "a.hdr", radiance("-Y 1 +X 4", {1, 1, 1, 2, 9, 8, 7, 136}));
  EXPECT_NE(failure(folder / "a.hdr").find("scanline"), std::string::npos);
}

TEST(ReadImage, RefusesWhatIsNoPicture) {
  const ScratchFolder folder;
  spill(folder / "a.txt", "hello");
  EXPECT_EQ(failure(folder / "a.txt"),
            ": the picture cannot be read: it is no EXR, PNG or Radiance HDR file");
  spill(folder / "empty.exr", "");
  EXPECT_EQ(failure(folder / "empty.exr"), ": the file is empty");
  EXPECT_EQ(failure(folder / "none.exr"), ": cannot be opened: no such file or directory");
  EXPECT_EQ(failure(folder.path()), ": is a directory, not a file");
}

TEST(ReadImage, ReadsRealEnvironments) {
  const std::filesystem::path envmaps = "/work/shared/data/envmaps";
  if (!std::filesystem::exists(envmaps)) GTEST_SKIP() << envmaps << " is not here";
  // Largest values as in the folder's manifest, to its number of digits.
  const std::pair<const char*, float> files[] = {{"city.exr", 3.395e4F},
                                                 {"courtyard.exr", 55.56F},
                                                 {"studio.exr", 118.4F},
                                                 {"sunset.exr", 6520.0F},
                                                 {"royal_esplanade_1k.hdr", 342.0F},
                                                 {"venice_sunset_1k.hdr", 6496.0F}};
  for (const auto& [name, largest] : files) {
    const auto image = read_image(envmaps / name);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 1024U) << name;
    EXPECT_EQ(image->height, 512U) << name;
    float found = 0.0F;
    for (const char* channel : {"R", "G", "B"}) {
      const auto values = values_of(*image, channel);
      ASSERT_FALSE(values.empty()) << name << " " << channel;
      found = std::max(found, *std::max_element(values.begin(), values.end()));
    }
    EXPECT_NEAR(found, largest, 1e-3F * largest) << name;
  }
}

}  // namespace
}  // namespace relief

// OpenEXR: what is written is read again, other programs' files are read right, bad ones are
// refused.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <cstring>
#include <limits>

#include "tests/common/image/image_testing.h"

namespace relief {
namespace {

using test::failure;
using test::make_channel;
using test::ScratchFolder;
using test::slurp;
using test::spill;

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

TEST(Exr, RefusesAttributesBeyondItsEnd) {
  // OpenEXR took 0x3700_0000 bytes for the attribute before it saw that 3 follow.
  const ScratchFolder folder;
  const std::string start =
      std::string("\x76\x2F\x31\x01\x02\0\0\0", 8) + std::string("name\0type\0", 10);
  const std::string bytes = start + std::string(
                                        "\0\0\0\x37"
                                        "abc",
                                        7);
  spill(folder / "a.exr", bytes);
  EXPECT_NE(failure(folder / "a.exr").find("longer than the file"), std::string::npos);
  // In the second of several headers.
  std::string parts = start + std::string("\1\0\0\0x\0", 6) + bytes.substr(8);
  parts[5] = 0x10;
  spill(folder / "a.exr", parts);
  EXPECT_NE(failure(folder / "a.exr").find("longer than the file"), std::string::npos);
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

}  // namespace
}  // namespace relief

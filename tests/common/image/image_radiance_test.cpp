// Radiance HDR: flat pixels, old and new runs; unsupported files are refused.
#include "tests/common/image/image_testing.h"

namespace relief {
namespace {

using test::failure;
using test::ScratchFolder;
using test::spill;
using test::values_of;

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
  // Runs that leave the image, or that repeat a pixel that is not there.
  spill(folder / "a.hdr", radiance("-Y 1 +X 4", {9, 8, 7, 136, 1, 1, 1, 200}));
  EXPECT_NE(failure(folder / "a.hdr").find("scanline"), std::string::npos);
  spill(folder / "a.hdr", radiance("-Y 1 +X 4", {1, 1, 1, 2, 9, 8, 7, 136}));
  EXPECT_NE(failure(folder / "a.hdr").find("scanline"), std::string::npos);
}

}  // namespace
}  // namespace relief

// JPEG images: colours, and damage.
#include <gtest/gtest.h>
#include <turbojpeg.h>

#include "common/image/image_io.h"
#include "common/image/srgb.h"

namespace relief {
namespace {

/// An image of one colour, at the best quality.
std::vector<std::byte> encode(int side, glm::u8vec3 colour, int format = TJPF_RGB) {
  std::vector<unsigned char> pixels;
  for (int k = 0; k < side * side; ++k) {
    pixels.insert(pixels.end(), {colour.r, colour.g, colour.b});
    if (tjPixelSize[format] == 4) pixels.push_back(0);
  }
  void* const encoder = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long count = 0;  // NOLINT: as libjpeg-turbo has it
  EXPECT_EQ(tjCompress2(encoder, pixels.data(), side, 0, side, format, &bytes, &count, TJSAMP_444,
                        100, 0),
            0);
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes);
  std::vector<std::byte> made(begin, begin + count);
  tjFree(bytes);
  tjDestroy(encoder);
  return made;
}

TEST(Jpeg, ColoursComeBack) {
  const auto image = decode_image("a.jpg", encode(20, {200, 40, 90}));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 20U);
  ASSERT_EQ(image->channels.size(), 3U);
  // YCbCr of 8 bits at quality 100: a step or two of rounding.
  EXPECT_NEAR(srgb8_from_linear(image->channels[0].values[57]), 200, 2);
  EXPECT_NEAR(srgb8_from_linear(image->channels[1].values[57]), 40, 2);
  EXPECT_NEAR(srgb8_from_linear(image->channels[2].values[57]), 90, 2);
}

TEST(Jpeg, EveryTruncationIsRefused) {
  const std::vector<std::byte> whole = encode(20, {200, 40, 90});
  // The last two bytes say that the image ends, which nobody needs to know.
  for (std::size_t length = 1; length + 2 < whole.size(); ++length) {
    const auto cut = decode_image("a.jpg", std::span(whole).first(length));
    ASSERT_FALSE(cut) << length;
    EXPECT_TRUE(cut.error().message.starts_with("a.jpg: ")) << cut.error().message;
  }
}

TEST(Jpeg, SizesAreCheckedBeforeAnythingIsAllocated) {
  std::vector<std::byte> large = encode(20, {1, 2, 3});
  // The frame header: FF C0, length, precision, height, width.
  for (std::size_t k = 0; k + 9 < large.size(); ++k) {
    if (large[k] != std::byte{0xFF} || large[k + 1] != std::byte{0xC0}) continue;
    for (const std::size_t b : {5U, 7U}) large[k + b] = std::byte{0xC0};
    for (const std::size_t b : {6U, 8U}) large[k + b] = std::byte{0x00};
    break;
  }
  const auto refused = decode_image("a.jpg", large);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("49152x49152"), std::string::npos)
      << refused.error().message;
}

TEST(Jpeg, PrintColoursAreRefused) {
  EXPECT_FALSE(decode_image("a.jpg", encode(20, {1, 2, 3}, TJPF_CMYK)));
}

}  // namespace
}  // namespace relief

// Reads JPEG images.
#include <turbojpeg.h>

#include <array>
#include <memory>

#include "common/image/image_formats.h"
#include "common/image/srgb.h"

namespace relief {
namespace {

struct Close {
  void operator()(void* decoder) const { tjDestroy(decoder); }
};

/// Rows of interleaved 8-bit sRGB to channels.
Image to_image(const std::vector<std::uint8_t>& pixels, std::uint32_t width, std::uint32_t height,
               Transfer transfer) {
  Image image{width, height, {}};
  const std::size_t count = std::size_t{width} * height;
  for (std::size_t c = 0; c < 3; ++c) {
    constexpr const char* kNames[] = {"R", "G", "B"};
    image.channels.push_back({kNames[c], ChannelType::Float, std::vector<float>(count)});
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint8_t value = pixels[3 * k + c];
      image.channels[c].values[k] = transfer == Transfer::Srgb ? linear_from_srgb8(value)
                                                               : static_cast<float>(value) / 255.0F;
    }
  }
  return image;
}

}  // namespace

bool is_jpeg(std::span<const std::byte> bytes) {
  return bytes.size() >= 3 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8} &&
         bytes[2] == std::byte{0xFF};
}

Result<Image> decode_jpeg(std::span<const std::byte> bytes, Transfer transfer) {
  const std::unique_ptr<void, Close> decoder(tjInitDecompress());
  if (decoder == nullptr)
    return make_error("not enough memory to decode it; free some memory, or use a smaller image");
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int sampling = 0;
  int space = 0;
  const auto damaged = [&decoder] {
    return make_error("it is damaged ({})", tjGetErrorStr2(decoder.get()));
  };
  if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &sampling, &space) !=
      0) {
    return damaged();
  }
  if (auto fault = find_size_fault(width, height, 3, bytes.size())) return *fault;
  std::vector<std::uint8_t> pixels(3 * static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height));
  // Stops at damaged data, and at progressive files that repeat scans for hours of work.
  constexpr int kFlags = TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS | TJFLAG_ACCURATEDCT;
  if (tjDecompress2(decoder.get(), data, bytes.size(), pixels.data(), width, 0, height, TJPF_RGB,
                    kFlags) != 0) {
    return damaged();
  }
  return to_image(pixels, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                  transfer);
}

}  // namespace relief

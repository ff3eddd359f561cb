// Fuzzes the readers of images: PNG, JPEG, EXR and Radiance.
#include "common/image/image_io.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  const auto image = relief::decode_image("fuzzed", bytes);
  if (!image) {
    relief::fuzz::require(image.error().message.starts_with("fuzzed: "));
    return 0;
  }
  for (const relief::Channel& channel : image->channels) {
    relief::fuzz::require(channel.values.size() == std::size_t{image->width} * image->height);
  }
  return 0;
}

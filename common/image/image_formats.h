// The image formats behind image_io.h, on bytes in memory. Decoders are safe on hostile bytes.
// Their errors are clauses without the file's name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// The largest side of an image that is read.
inline constexpr std::uint32_t kMaxImageSide = 65536;

[[nodiscard]] bool is_exr(std::span<const std::byte> bytes);
[[nodiscard]] bool is_png(std::span<const std::byte> bytes);
[[nodiscard]] bool is_jpeg(std::span<const std::byte> bytes);
[[nodiscard]] bool is_radiance(std::span<const std::byte> bytes);

Result<std::vector<std::byte>> encode_exr(const Image& image);
Result<std::vector<std::byte>> encode_png(const Image& image);

Result<Image> decode_exr(std::span<const std::byte> bytes);
Result<Image> decode_png(std::span<const std::byte> bytes, Transfer transfer);
/// Baseline and progressive, grey or colour; no CMYK.
Result<Image> decode_jpeg(std::span<const std::byte> bytes, Transfer transfer);
/// Radiance .hdr; pixels are mantissa * 2^(exponent - 136), EXPOSURE lines are not undone.
Result<Image> decode_radiance(std::span<const std::byte> bytes);

/// Returns why an image of this size is refused, as a clause; nothing if it is accepted. Refuses
/// sides of 0 or above kMaxImageSide, and more values than images need or than `file_bytes` bytes
/// can encode.
[[nodiscard]] std::optional<Error> find_size_fault(std::int64_t width, std::int64_t height,
                                                   std::size_t channels, std::size_t file_bytes);

}  // namespace relief

// Image files: writes EXR and PNG; reads EXR, PNG, JPEG and Radiance HDR.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// Writes every channel of `image` to an OpenEXR file (ZIP compression). The bytes do not depend on
/// the number of threads. Atomic as write_file_atomically.
Status write_exr(const std::filesystem::path& path, const Image& image);

/// Writes R, G, B as 8-bit sRGB PNG, with A if `image` has it and it is below 1 anywhere. R, G, B
/// are linear and premultiplied; PNG alpha is not premultiplied, so they are divided first. Values
/// outside [0, 1] are clamped. Atomic as write_file_atomically.
Status write_png(const std::filesystem::path& path, const Image& image);

/// Reads an EXR, Radiance HDR, PNG or JPEG image (recognised by its first bytes, not its name) with
/// all its channels. PNG and JPEG colours become linear. Non-finite values are kept.
Result<Image> read_image(const std::filesystem::path& path);

/// Decodes an image file in memory, as read_image does. Errors begin with `name`. With
/// Transfer::None, PNG and JPEG values stay as stored.
Result<Image> decode_image(const std::string& name, std::span<const std::byte> bytes,
                           Transfer transfer = Transfer::Srgb);

/// Returns whether the file begins as a PNG, so that its colours are display values and not light.
/// Also false if the file cannot be read; read_image then reports why.
[[nodiscard]] bool is_png_file(const std::filesystem::path& path);

}  // namespace relief

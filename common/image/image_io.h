// Pictures in files: EXR and PNG out; EXR, PNG, JPEG and Radiance HDR in (environment maps,
// comparisons, textures).
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "common/error.h"
#include "common/image/image.h"

namespace relief {

/// Writes every channel of `image` to an OpenEXR file (ZIP compression; the same image gives the
/// same bytes whatever the number of threads). Atomic as write_file_atomically.
Status write_exr(const std::filesystem::path& path, const Image& image);

/// Writes R, G, B as 8-bit sRGB PNG, with A if `image` has it and it is below 1 anywhere. R, G, B
/// are linear and premultiplied; PNG alpha is not premultiplied, so they are divided first. Values
/// outside [0, 1] are clamped. Atomic as write_file_atomically.
Status write_png(const std::filesystem::path& path, const Image& image);

/// Reads an EXR, Radiance HDR, PNG or JPEG picture (recognised by its first bytes, not its name)
/// with all its channels; PNG and JPEG colour is turned linear. Non-finite values are kept as they
/// are.
Result<Image> read_image(const std::filesystem::path& path);

/// The same of bytes in memory; `name` begins errors. With Transfer::None PNG and JPEG colours stay
/// as they are stored.
Result<Image> decode_image(const std::string& name, std::span<const std::byte> bytes,
                           Transfer transfer = Transfer::Srgb);

/// Whether the file starts as a PNG does, so that its colours are what a display shows and not
/// light. False also where there is no file to read: read_image says what is wrong with it.
[[nodiscard]] bool is_png_file(const std::filesystem::path& path);

}  // namespace relief

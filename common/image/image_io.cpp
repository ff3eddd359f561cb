#include "common/image/image_io.h"

#include <array>

#include "common/guard.h"
#include "common/image/image_formats.h"
#include "common/io/file.h"

namespace relief {
namespace {

template <class Encode>
Status write_image(const std::filesystem::path& path, const Image& image, const Encode& encode) {
  const auto bytes = guarded({.subject = "",
                              .task = "encode it",
                              .advice = kReportDefect,
                              .memory_advice = "free some memory, or render a smaller image"},
                             [&] { return encode(image); });
  if (!bytes) {
    return make_error("{}: the image cannot be written: {}", path.string(), bytes.error().message);
  }
  return write_file_atomically(path, *bytes);
}

}  // namespace

std::optional<Error> find_size_fault(std::int64_t width, std::int64_t height, std::size_t channels,
                                     std::size_t file_bytes) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
    return make_error("its size {}x{} is not within 1x1 to {}x{}", width, height, kMaxImageSide,
                      kMaxImageSide);
  }
  // 2 GiB as floats: an environment map of 16384 x 8192 pixels in colour.
  constexpr std::uint64_t kMaxValues = std::uint64_t{1} << 29U;
  // The tightest coding in use, DWAB of an image of one colour, stays below this.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  constexpr std::uint64_t kMaxValuesPerByte = 64;  // large images are slow and find nothing more
#else
  constexpr std::uint64_t kMaxValuesPerByte = 65536;
#endif
  const std::uint64_t pixels = static_cast<std::uint64_t>(width * height);
  if (channels > 1024 || pixels * channels > kMaxValues) {
    return make_error("{}x{} pixels of {} channels are too many", width, height, channels);
  }
  if (pixels * channels / kMaxValuesPerByte > file_bytes) {
    return make_error("{}x{} pixels of {} channels cannot be in {} bytes", width, height, channels,
                      file_bytes);
  }
  return std::nullopt;
}

Status write_exr(const std::filesystem::path& path, const Image& image) {
  return write_image(path, image, encode_exr);
}

Status write_png(const std::filesystem::path& path, const Image& image) {
  return write_image(path, image, encode_png);
}

Result<Image> read_image(const std::filesystem::path& path) {
  RELIEF_TRY_ASSIGN(const auto bytes, read_file(path));
  return decode_image(path.string(), bytes);
}

Result<Image> decode_image(const std::string& name, std::span<const std::byte> bytes,
                           Transfer transfer) {
  const auto decode = [&]() -> Result<Image> {
    if (is_exr(bytes)) return decode_exr(bytes);
    if (is_png(bytes)) return decode_png(bytes, transfer);
    if (is_jpeg(bytes)) return decode_jpeg(bytes, transfer);
    if (is_radiance(bytes)) return decode_radiance(bytes);
    return make_error("it is not an EXR, PNG, JPEG or Radiance HDR file");
  };
  auto image = guarded({.subject = "",
                        .task = "decode it",
                        .advice = "the file may be damaged: write it again",
                        .memory_advice = "free some memory, or use a smaller image"},
                       decode);
  if (image) return image;
  return make_error("{}: the image cannot be read: {}", name, image.error().message);
}

bool is_png_file(const std::filesystem::path& path) {
  const auto file = RandomAccessFile::open(path);
  std::array<std::byte, 8> start{};
  return file && file->read_at(0, start) && is_png(start);
}

}  // namespace relief

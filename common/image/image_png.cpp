// Writes PNG images of 8 bits, and reads those of 8 and 16 bits.
#include <png.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <csetjmp>
#include <cstring>
#include <string>

#include "common/image/image_formats.h"
#include "common/image/srgb.h"

namespace relief {
namespace {

/// The data of libpng's callbacks. libpng reports errors by longjmp, so no frame in between may
/// hold an object with a destructor; all storage belongs to the caller.
struct PngInput {
  const std::byte* bytes = nullptr;
  std::size_t left = 0;
  std::array<char, 128> error{};
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int channels = 0;
  int bits = 0;
};

void take_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* in = static_cast<PngInput*>(png_get_io_ptr(png));
  if (count > in->left) png_error(png, "it ends too early");
  std::memcpy(out, in->bytes, count);
  in->bytes += count;
  in->left -= count;
}

[[noreturn]] void keep_error(png_structp png, png_const_charp text) {
  auto* in = static_cast<PngInput*>(png_get_error_ptr(png));
  std::strncpy(in->error.data(), text, in->error.size() - 1);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*text*/) {}

/// Reads the header and asks for grey, grey-alpha, RGB or RGBA of 8 or 16 bits in the machine's
/// byte order.
bool read_header(png_structp png, png_infop info, PngInput* in) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: libpng reports errors by longjmp
  png_set_user_limits(png, kMaxImageSide, kMaxImageSide);
  png_set_read_fn(png, in, take_bytes);
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);  // no fuzzer gets past a checksum
#endif
  png_read_info(png, info);
  png_set_expand(png);  // palettes to RGB, 1, 2 and 4 bits to 8, transparent colour to alpha
  png_set_swap(png);    // 16 bits to little-endian
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  in->width = png_get_image_width(png, info);
  in->height = png_get_image_height(png, info);
  in->channels = png_get_channels(png, info);
  in->bits = png_get_bit_depth(png, info);
  return true;
}

bool read_rows(png_structp png, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: libpng reports errors by longjmp
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

/// Owns libpng's structures.
class PngReader {
 public:
  explicit PngReader(PngInput& in)
      : png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &in, keep_error, ignore_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {}
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  [[nodiscard]] png_structp png() const { return png_; }
  [[nodiscard]] png_infop info() const { return info_; }

 private:
  png_structp png_;
  png_infop info_;
};

/// Sample `index` of a row, scaled to [0, 1].
float sample_at(const std::uint8_t* row, std::size_t index, int bits) {
  if (bits == 8) return static_cast<float>(row[index]) / 255.0F;
  std::uint16_t value = 0;
  std::memcpy(&value, row + 2 * index, 2);
  return static_cast<float>(value) / 65535.0F;
}

/// Rows of interleaved sRGB samples with straight alpha to premultiplied channels.
Image to_image(const PngInput& in, const std::vector<std::uint8_t>& pixels, std::size_t row_bytes,
               Transfer transfer) {
  const bool has_alpha = in.channels == 2 || in.channels == 4;
  const auto channels = static_cast<std::size_t>(in.channels);
  Image image;
  image.width = in.width;
  image.height = in.height;
  for (const char* name : {"R", "G", "B", "A"}) {
    if (name[0] == 'A' && !has_alpha) break;
    image.channels.push_back({name, ChannelType::Float, {}});
    image.channels.back().values.resize(std::size_t{in.width} * in.height);
  }
  for (std::size_t y = 0; y < in.height; ++y) {
    const std::uint8_t* row = pixels.data() + y * row_bytes;
    for (std::size_t x = 0; x < in.width; ++x) {
      const std::size_t first = x * channels;
      const float alpha = has_alpha ? sample_at(row, first + channels - 1, in.bits) : 1.0F;
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = sample_at(row, first + (channels >= 3 ? c : 0), in.bits);
        image.channels[c].values[y * in.width + x] =
            alpha * (transfer == Transfer::Srgb ? linear_from_srgb(value) : value);
      }
      if (has_alpha) image.channels[3].values[y * in.width + x] = alpha;
    }
  }
  return image;
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
  return bytes.size() >= 8 &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) == 0;
}

Result<Image> decode_png(std::span<const std::byte> bytes, Transfer transfer) {
  PngInput in;
  in.bytes = bytes.data();
  in.left = bytes.size();
  const PngReader reader(in);
  if (reader.info() == nullptr)
    return make_error("not enough memory to decode it; free some memory, or use a smaller image");
  if (!read_header(reader.png(), reader.info(), &in)) {
    return make_error("it is damaged ({})", in.error.data());
  }
  if (auto fault = find_size_fault(in.width, in.height, static_cast<std::size_t>(in.channels),
                                   bytes.size())) {
    return *fault;
  }
  const std::size_t row_bytes = png_get_rowbytes(reader.png(), reader.info());
  std::vector<std::uint8_t> pixels(row_bytes * in.height);
  std::vector<png_bytep> rows(in.height);
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = pixels.data() + y * row_bytes;
  if (!read_rows(reader.png(), rows.data())) {
    return make_error("it is damaged ({})", in.error.data());
  }
  return to_image(in, pixels, row_bytes, transfer);
}

Result<std::vector<std::byte>> encode_png(const Image& image) {
  const Channel* const colour[3] = {image.find("R"), image.find("G"), image.find("B")};
  if (std::find(std::begin(colour), std::end(colour), nullptr) != std::end(colour)) {
    return make_error("it has no channels R, G and B");
  }
  const Channel* const alpha = image.find("A");
  // Negated so that NaN counts as not opaque.
  const bool has_alpha =
      alpha != nullptr &&
      !std::all_of(alpha->values.begin(), alpha->values.end(), [](float a) { return a >= 1.0F; });
  const std::size_t pixels = std::size_t{image.width} * image.height;
  std::vector<std::uint8_t> samples;
  samples.reserve(pixels * 4);
  for (std::size_t k = 0; k < pixels; ++k) {
    const float a = has_alpha ? alpha->values[k] : 1.0F;
    for (const Channel* channel : colour) {
      samples.push_back(a > 0.0F ? srgb8_from_linear(channel->values[k] / std::min(a, 1.0F)) : 0);
    }
    if (has_alpha) {
      samples.push_back(a > 0.0F
                            ? static_cast<std::uint8_t>(std::lround(std::min(a, 1.0F) * 255.0F))
                            : std::uint8_t{0});
    }
  }

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = image.width;
  png.height = image.height;
  png.format = has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, samples.data(), 0, nullptr) == 0) {
    return make_error("libpng failed to encode it ({}); write an EXR instead", png.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace relief

// Radiance .hdr images (Ward 1991, "Real Pixels"; the RLE codings of Radiance's color.c).
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "common/image/image_formats.h"

namespace relief {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

/// Takes bytes from the front; every function returns whether there were enough.
struct Input {
  std::span<const std::byte> bytes;

  bool take(std::uint8_t& byte) {
    if (bytes.empty()) return false;
    byte = std::to_integer<std::uint8_t>(bytes[0]);
    bytes = bytes.subspan(1);
    return true;
  }
  bool take(Rgbe& pixel) {
    return take(pixel[0]) && take(pixel[1]) && take(pixel[2]) && take(pixel[3]);
  }
  /// A line without its end. Lines of a header are short.
  bool take_line(std::string& line) {
    constexpr std::size_t kLongest = 4096;
    line.clear();
    for (std::uint8_t byte = 0; take(byte);) {
      if (byte == '\n') {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        return true;
      }
      if (line.size() == kLongest) return false;
      line.push_back(static_cast<char>(byte));
    }
    return false;
  }
};

Error ends_early() {
  return make_error("it ends too early; it is truncated");
}

/// "-Y HEIGHT +X WIDTH", the only order of pixels in use.
bool parse_resolution(std::string_view line, std::int64_t& width, std::int64_t& height) {
  const auto take_word = [&line](std::string_view word) {
    if (line.substr(0, word.size()) != word) return false;
    line.remove_prefix(word.size());
    return true;
  };
  const auto take_number = [&line](std::int64_t& number) {
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc()) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    return true;
  };
  return take_word("-Y ") && take_number(height) && take_word(" +X ") && take_number(width) &&
         line.empty();
}

/// One component of a scanline after another, in runs (byte above 128: that many less 128 times the
/// next byte) and stretches.
Status read_new_rle(Input& in, std::vector<Rgbe>& row) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < row.size();) {
      std::uint8_t count = 0;
      std::uint8_t value = 0;
      if (!in.take(count)) return ends_early();
      const bool run = count > 128;
      const std::size_t length = run ? count - 128U : count;
      if (length == 0 || length > row.size() - x) {
        return make_error("a run leaves its scanline; it is damaged");
      }
      for (std::size_t k = 0; k < length; ++k) {
        if ((!run || k == 0) && !in.take(value)) return ends_early();
        row[x++][component] = value;
      }
    }
  }
  return {};
}

/// Reads a row of whole pixels. 1, 1, 1, n repeats the previous pixel n times; in a run of these
/// pixels, each further n is shifted by 8 more bits. `first` is the row's first pixel, already
/// read.
Status read_old_rle(Input& in, const Rgbe& first, std::vector<Rgbe>& row) {
  Rgbe pixel = first;
  unsigned shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
      const std::uint64_t length = shift < 32 ? std::uint64_t{pixel[3]} << shift : 0;
      if (x == 0 || length > row.size() - x) {
        return make_error("a run leaves its scanline; it is damaged");
      }
      for (std::uint64_t k = 0; k < length; ++k, ++x) row[x] = row[x - 1];
      shift += 8;
    } else {
      row[x++] = pixel;
      shift = 0;
    }
    if (x < row.size() && !in.take(pixel)) return ends_early();
  }
  return {};
}

Status read_scanline(Input& in, std::vector<Rgbe>& row) {
  Rgbe first{};
  if (!in.take(first)) return ends_early();
  const bool is_new = first[0] == 2 && first[1] == 2 && first[2] < 128;
  if (!is_new || row.size() < 8 || row.size() > 32767) return read_old_rle(in, first, row);
  if ((std::size_t{first[2]} << 8U | first[3]) != row.size()) {
    return make_error("a scanline has another width than the image; it is damaged");
  }
  return read_new_rle(in, row);
}

}  // namespace

bool is_radiance(std::span<const std::byte> bytes) {
  return bytes.size() >= 2 && bytes[0] == std::byte{'#'} && bytes[1] == std::byte{'?'};
}

Result<Image> decode_radiance(std::span<const std::byte> bytes) {
  Input in{bytes};
  std::string line;
  do {
    if (!in.take_line(line)) return make_error("its header does not end");
    constexpr std::string_view kFormat = "FORMAT=";
    if (line.starts_with(kFormat) && line.substr(kFormat.size()) != "32-bit_rle_rgbe") {
      return make_error("its pixels are {}, not 32-bit_rle_rgbe", line.substr(kFormat.size(), 40));
    }
  } while (!line.empty());
  std::int64_t width = 0;
  std::int64_t height = 0;
  if (!in.take_line(line)) return make_error("its header does not end");
  if (!parse_resolution(line, width, height)) {
    return make_error("its resolution is '{}' where '-Y HEIGHT +X WIDTH' is expected",
                      line.substr(0, 40));
  }
  if (const auto fault = find_size_fault(width, height, 3, bytes.size())) return *fault;

  Image image;
  image.width = static_cast<std::uint32_t>(width);
  image.height = static_cast<std::uint32_t>(height);
  for (const char* name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Float, {}});
    image.channels.back().values.resize(std::size_t{image.width} * image.height);
  }
  std::vector<Rgbe> row(image.width);
  for (std::size_t y = 0; y < image.height; ++y) {
    RELIEF_TRY(read_scanline(in, row));
    for (std::size_t x = 0; x < row.size(); ++x) {
      const Rgbe& pixel = row[x];
      // 128 of excess and 8 for mantissas of 0 to 255 instead of 0 to 1.
      const float unit = pixel[3] == 0 ? 0.0F : std::ldexp(1.0F, int{pixel[3]} - 136);
      for (std::size_t c = 0; c < 3; ++c) {
        image.channels[c].values[y * image.width + x] = static_cast<float>(pixel[c]) * unit;
      }
    }
  }
  return image;
}

}  // namespace relief

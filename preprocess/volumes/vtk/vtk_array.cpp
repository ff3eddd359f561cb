#include "preprocess/volumes/vtk/vtk_array.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "preprocess/readers/gzip/inflate.h"
#include "preprocess/readers/number_type.h"
#include "preprocess/readers/source.h"
#include "preprocess/volumes/encoded_bytes.h"
#include "preprocess/volumes/value_collector.h"
#include "preprocess/volumes/volume_values.h"

namespace relief {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 10> kVtkTypes = {{
    {"Int8", NumberType::Int8},
    {"UInt8", NumberType::Uint8},
    {"Int16", NumberType::Int16},
    {"UInt16", NumberType::Uint16},
    {"Int32", NumberType::Int32},
    {"UInt32", NumberType::Uint32},
    {"Int64", NumberType::Int64},
    {"UInt64", NumberType::Uint64},
    {"Float32", NumberType::Float32},
    {"Float64", NumberType::Float64},
}};

std::optional<NumberType> vtk_type(std::string_view name) {
  const auto* const row =
      std::ranges::find(kVtkTypes, name, &std::pair<std::string_view, NumberType>::first);
  return row == kVtkTypes.end() ? std::nullopt : std::optional(row->second);
}

/// The sizes that stand before the bytes of an array.
struct VtkSizes {
  std::size_t bytes_each;
  bool is_big_endian;

  [[nodiscard]] std::uint64_t at(std::span<const std::byte> bytes, std::size_t index) const {
    const char* const at = reinterpret_cast<const char*>(bytes.data()) + index * bytes_each;
    using namespace detail;
    if (bytes_each == 4) {
      return is_big_endian ? load<std::uint32_t, std::uint32_t, true>(at)
                           : load<std::uint32_t, std::uint32_t, false>(at);
    }
    return is_big_endian ? load<std::uint64_t, std::uint64_t, true>(at)
                         : load<std::uint64_t, std::uint64_t, false>(at);
  }
};

/// What an array's bytes are read with.
struct VtkArrayBytes {
  const VolumeSource& source;
  std::string array;  ///< its name in quotes, for messages
  ValueBlock block;
  VtkSizes sizes;
  EncodedBytes encoded;
};

Error damaged_array(const VtkArrayBytes& from) {
  return make_error(
      "{}: the array {} ends early or is not encoded as the file says; the file is truncated or "
      "damaged",
      from.source.name, from.array);
}

/// The number of bytes, then the bytes, encoded as one.
template <class Real>
Result<std::vector<Real>> read_plain_array(VtkArrayBytes& from) {
  EncodedBytes start = from.encoded;
  std::span<const std::byte> bytes;
  if (!start.take(from.sizes.bytes_each, bytes)) return damaged_array(from);
  const std::uint64_t size = from.sizes.at(bytes, 0);
  if (size > from.encoded.left() || !from.encoded.take(from.sizes.bytes_each + size, bytes))
    return damaged_array(from);
  return read_values<Real>(from.source.name, bytes.subspan(from.sizes.bytes_each), from.block,
                           from.source.progress);
}

/// The number of blocks, the size of a block and of the last one before compression, and the
/// compressed size of each, encoded as one; then the blocks, encoded as one.
template <class Real>
Result<std::vector<Real>> read_blocks(VtkArrayBytes& from) {
  const std::size_t each = from.sizes.bytes_each;
  EncodedBytes start = from.encoded;
  std::span<const std::byte> bytes;
  if (!start.take(each, bytes)) return damaged_array(from);
  const std::uint64_t blocks = from.sizes.at(bytes, 0);
  if (blocks > from.encoded.left() / each || !from.encoded.take((3 + blocks) * each, bytes))
    return damaged_array(from);
  std::vector<std::uint64_t> packed_sizes;
  std::uint64_t packed_size = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    packed_sizes.push_back(from.sizes.at(bytes, 3 + k));
    if (packed_sizes.back() > from.encoded.left() - packed_size) return damaged_array(from);
    packed_size += packed_sizes.back();
  }
  if (!from.encoded.take(packed_size, bytes)) return damaged_array(from);

  const ValueBlock& block = from.block;
  ValueCollector<Real> collector(block.form, block.count,
                                 kLikelyVolumeRatio * packed_size / size_of(block.form.type));
  for (const std::uint64_t size : packed_sizes) {
    RELIEF_TRY(inflate_pieces(from.source.name, bytes.first(size), DeflateForm::Zlib,
                              from.source.progress,
                              [&](std::span<const std::byte> piece, std::size_t) -> Result<bool> {
                                collector.take(piece);
                                if (collector.surplus() > 0)
                                  return too_many_values(from.source.name, block);
                                return true;
                              }));
    bytes = bytes.subspan(size);
    from.source.progress.advance(size);
  }
  if (!collector.is_complete()) return too_few_values(from.source.name, block, collector.taken());
  return collector.release();
}

/// Finds the bytes of an array: in its element, or in the appended data.
Result<EncodedBytes> find_array_bytes(const VolumeSource& source, const VtkDocument& document,
                                      const VtkArray& array) {
  if (array.format == "binary") return EncodedBytes(array.text, true);
  if (array.format != "appended") {
    return make_error("{}: the array {} has the format {}; expected ascii, binary or appended",
                      source.name, relief::quoted(array.name), relief::quoted(array.format));
  }
  std::uint64_t offset = 0;
  const char* const end = array.offset.data() + array.offset.size();
  const auto [stop, code] = std::from_chars(array.offset.data(), end, offset);
  if (code != std::errc{} || stop != end || offset >= document.appended.size()) {
    return make_error(
        "{}: the array {} begins at byte {} of the appended data, which has {}; the file is "
        "truncated or damaged",
        source.name, relief::quoted(array.name), relief::quoted(array.offset),
        document.appended.size());
  }
  const bool is_base64 = document.appended_encoding == "base64";
  if (!is_base64 && document.appended_encoding != "raw") {
    return make_error("{}: its appended data is encoded as {}; expected raw or base64", source.name,
                      relief::quoted(document.appended_encoding));
  }
  return EncodedBytes(document.appended.substr(offset), is_base64);
}

}  // namespace

template <class Real>
Result<std::vector<Real>> read_vtk_array(const VolumeSource& source, const VtkDocument& document,
                                         const VtkArray& array, std::uint64_t count) {
  const auto type = vtk_type(array.type);
  if (!type) {
    return make_error(
        "{}: the array {} is of the type {}; expected Int8 to UInt64, Float32 or "
        "Float64",
        source.name, relief::quoted(array.name), relief::quoted(array.type));
  }
  if (array.format == "ascii")
    return read_text_values<Real>(source.name, array.text, count, source.progress);
  RELIEF_TRY_ASSIGN(auto encoded, find_array_bytes(source, document, array));
  const bool is_big_endian = document.byte_order == "BigEndian";
  const std::size_t bytes_each = document.header_type == "UInt64" ? 8 : 4;
  VtkArrayBytes from{source,
                     relief::quoted(array.name),
                     {.form = {*type, is_big_endian}, .count = count, .most_surplus = 0},
                     {bytes_each, is_big_endian},
                     std::move(encoded)};
  return document.compressor.empty() ? read_plain_array<Real>(from) : read_blocks<Real>(from);
}

template Result<std::vector<float>> read_vtk_array(const VolumeSource&, const VtkDocument&,
                                                   const VtkArray&, std::uint64_t);
template Result<std::vector<double>> read_vtk_array(const VolumeSource&, const VtkDocument&,
                                                    const VtkArray&, std::uint64_t);

}  // namespace relief

#include "preprocess/readers/ply/ply_header.h"

#include <algorithm>
#include <utility>

#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

std::optional<NumberType> type_of(std::string_view word) {
  constexpr std::pair<std::string_view, NumberType> types[] = {
      {"char", NumberType::Int8},      {"int8", NumberType::Int8},
      {"uchar", NumberType::Uint8},    {"uint8", NumberType::Uint8},
      {"short", NumberType::Int16},    {"int16", NumberType::Int16},
      {"ushort", NumberType::Uint16},  {"uint16", NumberType::Uint16},
      {"int", NumberType::Int32},      {"int32", NumberType::Int32},
      {"uint", NumberType::Uint32},    {"uint32", NumberType::Uint32},
      {"float", NumberType::Float32},  {"float32", NumberType::Float32},
      {"double", NumberType::Float64}, {"float64", NumberType::Float64}};
  for (const auto& [name, type] : types) {
    if (name == word) return type;
  }
  return std::nullopt;
}

/// The rest of a line that begins with "property": TYPE NAME or list TYPE TYPE NAME.
std::optional<PlyProperty> read_property(TextCursor& line) {
  PlyProperty property;
  if (line.peek() == "list") {
    (void)line.word();
    property.count_type = type_of(line.peek());
    if (!property.count_type) return std::nullopt;
    (void)line.word();
  }
  const auto type = type_of(line.peek());
  if (!type) return std::nullopt;
  (void)line.word();
  property.type = *type;
  property.name = lower_case(line.word());
  if (property.name.empty()) return std::nullopt;
  return property;
}

std::optional<PlyEncoding> encoding_of(std::string_view word) {
  if (word == "ascii") return PlyEncoding::Ascii;
  if (word == "binary_little_endian") return PlyEncoding::LittleEndian;
  if (word == "binary_big_endian") return PlyEncoding::BigEndian;
  return std::nullopt;
}

/// The offset of the body, given the offset of the end of the last header line. A binary body may
/// begin with a byte that looks like a line end, so exactly one is skipped: what ends the first
/// line.
std::size_t body_offset(std::string_view text, std::size_t line_end) {
  const std::size_t first = text.find_first_of("\r\n");
  if (text[first] == '\n') return std::min(text.find('\n', line_end), text.size() - 1) + 1;
  const bool two = text.substr(first, 2) == "\r\n" && text.substr(line_end, 2) == "\r\n";
  return std::min(line_end + (two ? 2 : 1), text.size());
}

}  // namespace

Result<PlyHeader> read_ply_header(const Source& source) {
  PlyHeader header;
  std::optional<PlyEncoding> encoding;
  TextCursor line(source.text);
  const auto wrong = [&](std::string_view what) {
    return make_error("{}: {}; the header is damaged", source.name, line.expected(what));
  };

  if (!line.next_line() || line.word() != "ply") {
    return make_error("{}: does not begin with 'ply', so it is not a PLY file", source.name);
  }
  for (;;) {
    if (!line.next_line()) {
      return make_error("{}: line {}: the file ends within its header; it is truncated",
                        source.name, line.line_number());
    }
    const std::string_view keyword = line.peek();
    if (keyword == "comment") {
      (void)line.word();
      const std::string key = lower_case(line.word());
      if (key == "texturefile") header.textures.emplace_back(trimmed(line.rest_of_line()));
      if (key == "splatrendermode:" || key == "splatrendermode")
        header.splat_render_mode = lower_case(trimmed(line.rest_of_line()));
      continue;
    }
    if (keyword == "obj_info") continue;
    if (keyword == "end_header") break;
    if (keyword == "format") {
      (void)line.word();
      encoding = encoding_of(line.peek());
      if (!encoding) return wrong("ascii, binary_little_endian or binary_big_endian");
    } else if (keyword == "element") {
      (void)line.word();
      PlyElement element;
      element.name = lower_case(line.word());
      std::int64_t count = 0;
      if (!line.integer(count, 0)) return wrong("the number of elements");
      element.count = static_cast<std::uint64_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property" && !header.elements.empty()) {
      (void)line.word();
      auto property = read_property(line);
      if (!property) return wrong("the type and name of a property");
      header.elements.back().properties.push_back(std::move(*property));
    } else {
      return wrong("a PLY header line");
    }
  }
  if (!encoding)
    return make_error("{}: the header has no 'format' line; it is damaged", source.name);
  header.encoding = *encoding;
  line.skip_line();
  header.body = body_offset(source.text, line.offset());
  return header;
}

}  // namespace relief

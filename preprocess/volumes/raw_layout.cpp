#include "preprocess/volumes/raw_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 8> kRawTypes = {{
    {"u8", NumberType::Uint8},
    {"i8", NumberType::Int8},
    {"u16", NumberType::Uint16},
    {"i16", NumberType::Int16},
    {"u32", NumberType::Uint32},
    {"i32", NumberType::Int32},
    {"f32", NumberType::Float32},
    {"f64", NumberType::Float64},
}};

/// Returns the text before the first `separator` and removes both from `text`.
std::string_view take_part(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

/// Reads three parts, and nothing after them, with `read`, which fails on a part.
template <class Read>
bool take_three(std::string_view text, char separator, const Read& read) {
  if (std::ranges::count(text, separator) != 2) return false;
  for (glm::length_t c = 0; c < 3; ++c) {
    if (!read(c, take_part(text, separator))) return false;
  }
  return true;
}

std::optional<glm::uvec3> parse_size(std::string_view text) {
  glm::uvec3 size(0);
  const bool good = take_three(text, 'x', [&](glm::length_t c, std::string_view part) {
    const char* const end = part.data() + part.size();
    const auto [stop, code] = std::from_chars(part.data(), end, size[c]);
    return code == std::errc{} && stop == end && size[c] > 0;
  });
  return good ? std::optional(size) : std::nullopt;
}

std::optional<glm::dvec3> parse_spacing(std::string_view text) {
  glm::dvec3 spacing(0.0);
  const bool good = take_three(text, ',', [&](glm::length_t c, std::string_view part) {
    return parse_number(part, spacing[c]) && spacing[c] > 0.0;
  });
  return good ? std::optional(spacing) : std::nullopt;
}

Error bad_layout(std::string_view text, std::string_view part, std::string_view expected) {
  return make_error(
      "raw layout {}: expected {}, found {}; a layout is SIZExSIZExSIZE:TYPE[:be][:X,Y,Z], as in "
      "256x256x109:u8 or 64x64x32:f32:be:1,1,2.5",
      relief::quoted(text), expected, part.empty() ? "nothing" : relief::quoted(part));
}

}  // namespace

Result<RawLayout> parse_raw_layout(std::string_view text) {
  RawLayout layout;
  std::string_view left = text;
  const std::string_view size = take_part(left, ':');
  const auto parsed_size = parse_size(size);
  if (!parsed_size) return bad_layout(text, size, "three sizes above 0, separated by x");
  layout.size = *parsed_size;

  const std::string_view type = take_part(left, ':');
  const auto* const row =
      std::ranges::find(kRawTypes, type, &std::pair<std::string_view, NumberType>::first);
  if (row == kRawTypes.end())
    return bad_layout(text, type, "the type u8, i8, u16, i16, u32, i32, f32 or f64");
  layout.form.type = row->second;

  bool has_order = false;
  bool has_spacing = false;
  while (!left.empty()) {
    const std::string_view part = take_part(left, ':');
    if (!has_order && (part == "be" || part == "le")) {
      layout.form.is_big_endian = part == "be";
      has_order = true;
    } else if (const auto spacing = parse_spacing(part); spacing && !has_spacing) {
      layout.spacing = *spacing;
      has_spacing = true;
    } else {
      return bad_layout(text, part, "be, le or three spacings above 0, separated by commas");
    }
  }
  return layout;
}

std::string text_of(const RawLayout& layout) {
  const auto* const row = std::ranges::find(kRawTypes, layout.form.type,
                                            &std::pair<std::string_view, NumberType>::second);
  const std::string_view type = row == kRawTypes.end() ? std::string_view() : row->first;
  const glm::dvec3& spacing = layout.spacing;
  return fmt::format("{}x{}x{}:{}{}:{},{},{}", layout.size.x, layout.size.y, layout.size.z, type,
                     layout.form.is_big_endian ? ":be" : "", spacing.x, spacing.y, spacing.z);
}

}  // namespace relief

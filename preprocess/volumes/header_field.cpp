#include "preprocess/volumes/header_field.h"

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {

Error wrong_field(const FieldPlace& place, std::string_view expected, std::string_view found) {
  return make_error("{}: line {}: expected {}, found {}", place.name, place.line, expected,
                    found.empty() ? "nothing" : relief::quoted(found));
}

Status parse_sizes(const FieldPlace& place, std::string_view value,
                   std::array<std::int64_t, 3>& sizes) {
  constexpr std::string_view kExpected = "three sizes above 0";
  TextCursor cursor(value);
  for (std::int64_t& size : sizes) {
    if (!cursor.integer(size, 1)) return wrong_field(place, kExpected, value);
  }
  if (!cursor.at_line_end()) return wrong_field(place, kExpected, value);
  return {};
}

}  // namespace relief

// The layout of a volume file without a header.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "common/error.h"
#include "preprocess/volumes/number_form.h"

namespace relief {

/// What a file without a header does not say. x varies fastest.
struct RawLayout {
  glm::uvec3 size{0};  ///< nodes along x, y and z, each at least 1
  NumberForm form;
  glm::dvec3 spacing{1.0};  ///< world units, above 0
};

/// Parses a layout as `256x256x109:u8` states it: the size, then the type (u8 i8 u16 i16 u32 i32
/// f32 f64), then, in any order and both optional, `be` or `le` for the byte order (default: little
/// endian) and the spacing along x, y and z, as in `64x64x32:f32:be:1,1,2.5`.
Result<RawLayout> parse_raw_layout(std::string_view text);

/// Returns the text of a layout, such that parse_raw_layout() gives it back to the bit.
[[nodiscard]] std::string text_of(const RawLayout& layout);

}  // namespace relief

// What is left of a shader's text after its preprocessor: what a variant pays for.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace relief {

/// Returns the lines of a resolved shader (program.h) that its preprocessor leaves, without
/// comments, directives and blank lines. Macros are not replaced. Knows what our shaders use:
/// conditions of integers, macros without arguments and defined(NAME).
[[nodiscard]] std::string preprocess_shader(std::string_view text);

/// Returns the number of those lines.
[[nodiscard]] std::uint64_t count_shader_lines(std::string_view text);

}  // namespace relief

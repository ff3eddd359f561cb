// Programs from the shader files in shaders/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief {

/// The text of a shader file, as built into the library; empty if there is no such file. `path` is
/// relative to shaders/.
[[nodiscard]] std::string_view find_shader(std::string_view path);

/// A shader file with its #include lines replaced by the files they name (relative to shaders/,
/// each file once), after a first line with the version and `#define RELIEF_FEATURES features`.
/// #line directives number the files in the order of their first line.
[[nodiscard]] std::string resolve_shader(std::string_view path, std::uint32_t features);

/// Compiles and links two shader files. A failure names the file and says what OpenGL said.
Result<Program> make_program(const Gl& gl, std::string_view label, std::string_view vertex_path,
                             std::string_view fragment_path, std::uint32_t features);

}  // namespace relief

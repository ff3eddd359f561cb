// Programs from the shader files in shaders/.
#pragma once

#include <string>
#include <string_view>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/shader/features.h"

namespace relief {

/// A shader file with its #include lines replaced by the files they name (relative to shaders/,
/// each file once), after first lines with the version and the features.
/// #line directives number the files in the order of their first line.
[[nodiscard]] std::string resolve_shader(std::string_view path, Features features);

/// Compiles and links two shader files. A failure names the file and says what OpenGL said.
Result<Program> make_program(const Gl& gl, std::string_view label, std::string_view vertex_path,
                             std::string_view fragment_path, Features features);

}  // namespace relief

// The texts of the shader files in shaders/.
#pragma once

#include <string_view>

namespace relief {

/// The text of a shader file, as built into the library; empty if there is no such file. `path` is
/// relative to shaders/.
[[nodiscard]] std::string_view find_shader(std::string_view path);

}  // namespace relief

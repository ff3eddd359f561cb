#include "renderer/frame/clip_texels.h"

#include "shaders/include/shared.h"

namespace relief {

glm::uvec2 clip_range(std::size_t first_texel, std::size_t lines, ClipKind kind) {
  return {first_texel, lines << shared::kClipKindBits | static_cast<std::size_t>(kind)};
}

Result<Table> make_clip_lines(const Gl& gl, std::span<const glm::vec4> texels) {
  const auto most = static_cast<std::size_t>(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE));
  if (texels.size() > most) {
    return make_error("the clip lines take {} texels, more than this OpenGL has ({})",
                      texels.size(), most);
  }
  return make_table(gl, "clip lines", GL_RGBA32F, texels);
}

}  // namespace relief

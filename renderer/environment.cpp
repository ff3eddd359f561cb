#include "renderer/environment.h"

#include <bit>

#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {

Result<Texture> upload_environment(const Gl& gl, const CubeMap& cube) {
  const auto size = static_cast<GLsizei>(cube.size);
  if (size > get_limit(gl, GL_MAX_CUBE_MAP_TEXTURE_SIZE)) {
    return make_error("the environment needs cube faces of {} texels, but this OpenGL allows {}",
                      size, get_limit(gl, GL_MAX_CUBE_MAP_TEXTURE_SIZE));
  }
  Texture texture(gl, "environment", GLenum{GL_TEXTURE_CUBE_MAP});
  gl.TextureStorage2D(texture.id(), static_cast<GLsizei>(std::bit_width(cube.size)), GL_RGBA16F,
                      size, size);
  for (std::size_t face = 0; face < cube.faces.size(); ++face) {
    gl.TextureSubImage3D(texture.id(), 0, 0, 0, static_cast<GLint>(face), size, size, 1, GL_RGB,
                         GL_FLOAT, cube.faces[face].data());
  }
  gl.GenerateTextureMipmap(texture.id());
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const Status made = check_errors(gl, "the environment");
  if (!made) return made.error();
  return texture;
}

Result<Backdrop> Backdrop::create(const Gl& gl) {
  Result<Program> program =
      make_program(gl, "backdrop", "environment/screen.vert", "environment/backdrop.frag", 0);
  if (!program) return program.error();
  return Backdrop(gl, std::move(*program), VertexArray(gl, "no attributes"));
}

void Backdrop::draw(PassTimer& timer, const Texture& environment) const {
  const ScopedPass pass(*gl_, timer, "backdrop");
  gl_->Enable(GL_DEPTH_TEST);
  gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->DepthFunc(GL_EQUAL);  // where the depth is still the 0 it was cleared to
  gl_->DepthMask(GL_FALSE);
  gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->UseProgram(program_.id());
  gl_->BindVertexArray(nothing_.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_ENVIRONMENT, environment.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->BindTextureUnit(RELIEF_TEXTURE_ENVIRONMENT, 0);
  gl_->BindVertexArray(0);
  gl_->UseProgram(0);
  gl_->Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->DepthMask(GL_TRUE);
  gl_->DepthFunc(GL_LESS);
  gl_->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl_->Disable(GL_DEPTH_TEST);
}

}  // namespace relief

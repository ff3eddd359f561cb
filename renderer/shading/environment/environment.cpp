#include "renderer/shading/environment/environment.h"

#include <bit>

#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {

namespace {

/// A cube map or an array of them, whose faces follow each other. All have one size.
Result<Texture> upload_cubes(const Gl& gl, const char* label, GLenum target,
                             const std::vector<const CubeMap*>& cubes) {
  const auto size = static_cast<GLsizei>(cubes.front()->size);
  if (size > get_limit(gl, GL_MAX_CUBE_MAP_TEXTURE_SIZE)) {
    return make_error("the environment needs cube faces of {} texels, but this OpenGL allows {}",
                      size, get_limit(gl, GL_MAX_CUBE_MAP_TEXTURE_SIZE));
  }
  Texture texture(gl, label, GLenum{target});
  const auto levels = static_cast<GLsizei>(std::bit_width(cubes.front()->size));
  if (target == GL_TEXTURE_CUBE_MAP) {
    gl.TextureStorage2D(texture.id(), levels, GL_RGBA16F, size, size);
  } else {
    gl.TextureStorage3D(texture.id(), levels, GL_RGBA16F, size, size,
                        static_cast<GLsizei>(6 * cubes.size()));
  }
  GLint layer = 0;
  for (const CubeMap* cube : cubes) {
    for (const std::vector<glm::vec3>& face : cube->faces) {
      gl.TextureSubImage3D(texture.id(), 0, 0, 0, layer, size, size, 1, GL_RGB, GL_FLOAT,
                           face.data());
      ++layer;
    }
  }
  gl.GenerateTextureMipmap(texture.id());
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  RELIEF_TRY(check_errors(gl, "the environment"));
  return texture;
}

}  // namespace

Result<Texture> upload_environment(const Gl& gl, const CubeMap& cube) {
  return upload_cubes(gl, "environment", GL_TEXTURE_CUBE_MAP, {&cube});
}

Result<Texture> upload_environments(const Gl& gl, const std::vector<CubeMap>& cubes) {
  std::vector<const CubeMap*> all;
  all.reserve(cubes.size());
  for (const CubeMap& cube : cubes) all.push_back(&cube);
  return upload_cubes(gl, "rough environments", GL_TEXTURE_CUBE_MAP_ARRAY, all);
}

Result<Backdrop> Backdrop::create(const Gl& gl, Features features) {
  RELIEF_TRY_ASSIGN(Program program, make_program(gl, "backdrop", "environment/screen.vert",
                                                  "environment/backdrop.frag", features));
  return Backdrop(gl, std::move(program), VertexArray(gl, "no attributes"));
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

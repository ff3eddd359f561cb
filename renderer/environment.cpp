#include "renderer/environment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "common/image_io.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr GLsizei kFaces = 6;
constexpr std::uint32_t kSmallestFace = 64;
constexpr std::uint32_t kLargestFace = 2048;  // 200 MB with mip levels; pictures of 8192 texels
constexpr std::uint32_t kBuiltInFace = 512;
constexpr float kBrightest = 65000.0F;  // below the largest half float, 65504

// Uniform locations of shaders/include/cube_face.glsl and environment/equirectangular.frag.
constexpr GLint kFaceUniform = 0;
constexpr GLint kFaceSizeUniform = 1;
constexpr GLint kLodUniform = 2;

/// The colour of a picture, interleaved, bottom row last, fit for half floats.
Result<std::vector<glm::vec3>> colour_of(const Image& image, const std::filesystem::path& path) {
  const Channel* grey = image.find("Y");
  const Channel* red = image.find("R");
  const Channel* green = image.find("G");
  const Channel* blue = image.find("B");
  if (red == nullptr || green == nullptr || blue == nullptr) red = green = blue = grey;
  if (red == nullptr) {
    return make_error("{}: has no colour channels (R, G, B or Y); it can't be an environment",
                      path.string());
  }
  const auto finite = [](float v) {
    return std::isfinite(v) ? std::clamp(v, 0.0F, kBrightest) : 0.0F;
  };
  std::vector<glm::vec3> texels(red->values.size());
  for (std::size_t k = 0; k < texels.size(); ++k)
    texels[k] = {finite(red->values[k]), finite(green->values[k]), finite(blue->values[k])};
  return texels;
}

/// Uploads a picture; its sides wrap around, its poles do not.
Result<Texture> upload_picture(const Gl& gl, const std::filesystem::path& path,
                               const Image& image) {
  const auto largest = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_TEXTURE_SIZE));
  if (image.width > largest || image.height > largest) {
    return make_error("{}: {}x{} pixels, but this OpenGL allows {} a side; make it smaller",
                      path.string(), image.width, image.height, largest);
  }
  const auto texels = colour_of(image, path);
  if (!texels) return texels.error();
  Texture picture(gl, "environment picture", GLenum{GL_TEXTURE_2D});
  const auto levels = static_cast<GLsizei>(std::bit_width(std::max(image.width, image.height)));
  gl.TextureStorage2D(picture.id(), levels, GL_RGB16F, static_cast<GLsizei>(image.width),
                      static_cast<GLsizei>(image.height));
  const Status made = check_errors(gl, "the environment");
  if (!made) return made.error();
  gl.TextureSubImage2D(picture.id(), 0, 0, 0, static_cast<GLsizei>(image.width),
                       static_cast<GLsizei>(image.height), GL_RGB, GL_FLOAT, texels->data());
  gl.GenerateTextureMipmap(picture.id());
  gl.TextureParameteri(picture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(picture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TextureParameteri(picture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TextureParameteri(picture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return picture;
}

/// Draws the six faces with a program and makes the mip levels.
Result<Texture> draw_cube(const Gl& gl, const Program& program, std::uint32_t face_size) {
  Texture cube(gl, "environment", GLenum{GL_TEXTURE_CUBE_MAP});
  const auto size = static_cast<GLsizei>(face_size);
  gl.TextureStorage2D(cube.id(), static_cast<GLsizei>(std::bit_width(face_size)), GL_RGBA16F, size,
                      size);
  const Framebuffer framebuffer(gl, "cube face");
  const VertexArray nothing(gl, "no attributes");
  gl.UseProgram(program.id());
  gl.BindVertexArray(nothing.id());
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
  gl.Viewport(0, 0, size, size);
  gl.ProgramUniform1i(program.id(), kFaceSizeUniform, size);
  for (GLint face = 0; face < kFaces; ++face) {
    gl.NamedFramebufferTextureLayer(framebuffer.id(), GL_COLOR_ATTACHMENT0, cube.id(), 0, face);
    gl.ProgramUniform1i(program.id(), kFaceUniform, face);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.GenerateTextureMipmap(cube.id());
  gl.TextureParameteri(cube.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(cube.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const Status drawn = check_errors(gl, "the environment");
  if (!drawn) return drawn.error();
  return cube;
}

}  // namespace

Result<Texture> make_environment(const Gl& gl, const std::filesystem::path& path) {
  if (path.empty()) {
    const auto program =
        make_program(gl, "grid environment", "environment/screen.vert", "environment/grid.frag", 0);
    if (!program) return program.error();
    return draw_cube(gl, *program, kBuiltInFace);
  }
  const auto image = read_image(path);
  if (!image) return image.error();
  const auto picture = upload_picture(gl, path, *image);
  if (!picture) return picture.error();
  const auto program = make_program(gl, "equirectangular environment", "environment/screen.vert",
                                    "environment/equirectangular.frag", 0);
  if (!program) return program.error();
  // A face spans 90 of the picture's 180 degrees of height.
  const std::uint32_t face_size =
      std::bit_ceil(std::clamp(image->height / 2, kSmallestFace, kLargestFace));
  const float lod = std::log2(static_cast<float>(image->height) / (2.0F * face_size));
  gl.ProgramUniform1f(program->id(), kLodUniform, std::max(lod, 0.0F));
  gl.BindTextureUnit(0, picture->id());
  Result<Texture> cube = draw_cube(gl, *program, face_size);
  gl.BindTextureUnit(0, 0);
  return cube;
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

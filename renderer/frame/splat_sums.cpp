#include "renderer/frame/splat_sums.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/frame/features.h"
#include "renderer/frame/targets/attachments.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

void clear_sums(const Gl& gl, const SplatSums& sums) {
  const std::array<GLfloat, 4> zero{};
  const auto clear = [&](const std::optional<Texture>& sum, GLint location) {
    if (sum) gl.ClearNamedFramebufferfv(sums.accumulation.id(), GL_COLOR, location, zero.data());
  };
  clear(sums.normals, RELIEF_SUM_NORMAL);
  clear(sums.colours, RELIEF_SUM_COLOUR);
  clear(sums.depths, RELIEF_SUM_DEPTH);
}

}  // namespace

Result<SplatSums> make_sums(const Gl& gl, const Targets& targets, Features features,
                            SumPrecision precision, bool keeps_materials) {
  const auto make = [&](bool needed, const char* label, GLenum format) {
    return needed ? std::optional<Texture>(
                        make_attachment(gl, label, format, targets.width, targets.height))
                  : std::nullopt;
  };
  const GLenum format = precision == SumPrecision::Half ? GL_RGBA16F : GL_RGBA32F;
  auto normals = make(needs_normals(features), "normal sums", format);
  auto colours = make(features.has(RELIEF_FEATURE_COLOURS), "colour sums", format);
  auto depths = make(features.has(RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS),
                     "depth sums", GL_RG32F);
  auto materials =
      make(keeps_materials && features.has(RELIEF_FEATURE_MIXED), "materials", GL_R8UI);
  auto sides = make(features.has(RELIEF_FEATURE_SIDED), "sides", GL_R8UI);
  const Texture* z = &targets.z_buffer;
  const bool shows_clip = features.has(RELIEF_FEATURE_OUT_CLIP);
  Framebuffer visibility =
      make_framebuffer(gl, "visibility", z,
                       {{RELIEF_OUT_UV, address(targets.uv)},
                        {RELIEF_OUT_PATCH, address(targets.patch_id)},
                        {RELIEF_OUT_CLIP, shows_clip ? address(targets.clip) : nullptr},
                        {RELIEF_OUT_MATERIAL, address(materials)},
                        {RELIEF_OUT_SIDE, address(sides)}});
  Framebuffer accumulation = make_framebuffer(gl, "accumulation", z,
                                              {{RELIEF_SUM_NORMAL, address(normals)},
                                               {RELIEF_SUM_COLOUR, address(colours)},
                                               {RELIEF_SUM_DEPTH, address(depths)}});
  Framebuffer shading = make_framebuffer(gl, "shading", z,
                                         {{RELIEF_OUT_COLOUR, &targets.colour},
                                          {RELIEF_OUT_NORMAL, address(targets.normal)},
                                          {RELIEF_OUT_DEPTH, address(targets.depth)}});
  RELIEF_TRY(check_errors(gl, "the sums of splats"));
  return SplatSums{.normals = std::move(normals),
                   .colours = std::move(colours),
                   .depths = std::move(depths),
                   .materials = std::move(materials),
                   .sides = std::move(sides),
                   .visibility = std::move(visibility),
                   .accumulation = std::move(accumulation),
                   .shading = std::move(shading)};
}

SummingUp::SummingUp(const Gl& gl, const SplatSums& sums, SumBlend blend) : gl_(gl) {
  clear_sums(gl, sums);
  gl.BindFramebuffer(GL_FRAMEBUFFER, sums.accumulation.id());
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, blend == SumBlend::Over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
  gl.BindTextureUnit(RELIEF_TEXTURE_SIDES, sums.sides ? sums.sides->id() : 0);
}

SummingUp::~SummingUp() {
  gl_.BindTextureUnit(RELIEF_TEXTURE_SIDES, 0);
  gl_.BlendFunc(GL_ONE, GL_ZERO);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
}

void draw_shading_pass(const Gl& gl, const SplatSums& sums, const Program& program,
                       const VertexArray& nothing, const Texture* environment,
                       std::initializer_list<BoundTexture> beside) {
  std::vector<BoundTexture> textures{{RELIEF_TEXTURE_NORMAL_SUMS, address(sums.normals)},
                                     {RELIEF_TEXTURE_COLOUR_SUMS, address(sums.colours)},
                                     {RELIEF_TEXTURE_DEPTH_SUMS, address(sums.depths)},
                                     {RELIEF_TEXTURE_ENVIRONMENT, environment}};
  textures.insert(textures.end(), beside);
  gl.BindFramebuffer(GL_FRAMEBUFFER, sums.shading.id());
  gl.Enable(GL_DEPTH_TEST);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.DepthFunc(GL_LESS);  // the triangle is at 0, where what pass 1 covers is above
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.UseProgram(program.id());
  gl.BindVertexArray(nothing.id());
  for (const auto& [unit, texture] : textures)
    gl.BindTextureUnit(unit, texture == nullptr ? 0 : texture->id());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  for (const auto& [unit, texture] : textures) gl.BindTextureUnit(unit, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.DepthMask(GL_TRUE);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.Disable(GL_DEPTH_TEST);
}

}  // namespace relief

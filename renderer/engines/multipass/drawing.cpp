#include "renderer/engines/multipass/drawing.h"

#include <utility>

#include "renderer/frame/attachments.h"
#include "renderer/view/draw_list.h"
#include "shaders/include/shared.h"

namespace relief::multipass {

Drawing::Drawing(const Variant& variant, SplatSums sums, double radius_factor,
                 const ClipTables* clip)
    : variant_(variant), sums_(std::move(sums)), radius_factor_(radius_factor), clip_(clip) {}

void Drawing::draw(const GlFrame& frame, PassTimer& timer) const {
  const Gl& gl = *variant_.gl;
  const std::vector<std::uint32_t> visible =
      find_visible(variant_.samples.store(), frame.view, radius_factor_);
  const AllDraws draws = make_draws(frame.view, visible);
  variant_.samples.look(frame.view, visible);
  {
    const BoundModel bound(gl, variant_.samples, nullptr);
    if (clip_ != nullptr) gl.BindTextureUnit(RELIEF_TEXTURE_CLIP_LINES, clip_->lines.texture.id());
    {
      const ScopedPass pass(gl, timer, "visibility");
      see(draws);
    }
    if (has_any(sums_)) {
      const ScopedPass pass(gl, timer, "accumulation");
      accumulate(frame.targets.z_buffer, draws);
    }
    if (clip_ != nullptr) {
      gl.BindTextureUnit(RELIEF_TEXTURE_CLIP_LINES, 0);
      gl.BindTextureUnit(RELIEF_TEXTURE_CLIP_RANGES, 0);
    }
  }
  {
    const ScopedPass pass(gl, timer, "shading");
    shade(frame);
  }
  gl.BindFramebuffer(GL_FRAMEBUFFER, frame.targets.framebuffer.id());
}

Drawing::AllDraws Drawing::make_draws(const View& view,
                                      const std::vector<std::uint32_t>& visible) const {
  if (clip_ == nullptr) return {make_draws_of(view, visible), std::nullopt};
  std::vector<std::uint32_t> plain;
  std::vector<std::uint32_t> clipped;
  for (const std::uint32_t p : visible)
    (variant_.clipped->shows_kinds || clip_->clipped[p] ? clipped : plain).push_back(p);
  return {make_draws_of(view, plain), make_draws_of(view, clipped)};
}

Drawing::Draws Drawing::make_draws_of(const View& view,
                                      const std::vector<std::uint32_t>& visible) const {
  const PatchStore& store = variant_.samples.store();
  const auto make = [&](SampleShape shape, const std::vector<std::uint32_t>& patches) {
    return variant_.samples.make_draw(shape, by_cull_mode(store, view, patches));
  };
  if (!variant_.visibility.large) return {make(SampleShape::Triangles, visible), std::nullopt};
  Draws draws{make(SampleShape::Points, visible), std::nullopt};
  const double widest = double{shared::kCoveringSlack} * radius_factor_ * widest_disc(store);
  const std::vector<std::uint32_t> near =
      find_near(store, view, visible, widest, largest_sprite(*variant_.gl));
  if (!near.empty()) draws.large = make(SampleShape::Triangles, near);
  return draws;
}

void Drawing::see(const AllDraws& draws) const {
  variant_.gl->BindFramebuffer(GL_FRAMEBUFFER, sums_.visibility.id());
  draw_splats(variant_.visibility, draws.plain, {});
  if (draws.clipped)
    draw_splats(variant_.clipped->visibility, *draws.clipped,
                {RELIEF_TEXTURE_CLIP_RANGES, &clip_->ranges});
}

void Drawing::draw_splats(const SplatPrograms& programs, const Draws& draws,
                          const PageTables& beside) const {
  const Gl& gl = *variant_.gl;
  const auto run = [&](const Program& program, const SampleDraw& draw) {
    gl.ProgramUniform1f(program.id(), RELIEF_UNIFORM_RADIUS_FACTOR,
                        static_cast<GLfloat>(radius_factor_));
    variant_.samples.draw(draw, program, beside);
  };
  run(programs.all, draws.all);
  if (draws.large) run(*programs.large, *draws.large);
}

void Drawing::accumulate(const Texture& visible_depth, const AllDraws& draws) const {
  const Gl& gl = *variant_.gl;
  clear_sums(gl, sums_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, sums_.accumulation.id());
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_BLEND);
  gl.BlendFunc(GL_ONE, GL_ONE);
  if (variant_.accumulation.large) {
    // Sprites read the depth that is tested. Nothing writes it in this pass.
    gl.TextureBarrier();
    gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, visible_depth.id());
  }
  draw_splats(variant_.accumulation, draws.plain, {});
  if (draws.clipped)
    draw_splats(variant_.clipped->accumulation, *draws.clipped,
                {RELIEF_TEXTURE_CLIP_RANGES, &clip_->ranges});
  gl.BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl.BlendFunc(GL_ONE, GL_ZERO);
  gl.Disable(GL_BLEND);
  gl.DepthMask(GL_TRUE);
}

void Drawing::shade(const GlFrame& frame) const {
  const Gl& gl = *variant_.gl;
  gl.BindFramebuffer(GL_FRAMEBUFFER, sums_.shading.id());
  gl.Enable(GL_DEPTH_TEST);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.DepthFunc(GL_LESS);  // the triangle is at 0, where what pass 1 covers is above
  gl.DepthMask(GL_FALSE);
  gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.UseProgram(variant_.shading.id());
  gl.BindVertexArray(variant_.nothing.id());
  const auto bind = [&gl](GLuint unit, const Texture* texture) {
    gl.BindTextureUnit(unit, texture == nullptr ? 0 : texture->id());
  };
  bind(RELIEF_TEXTURE_NORMAL_SUMS, address(sums_.normals));
  bind(RELIEF_TEXTURE_COLOUR_SUMS, address(sums_.colours));
  bind(RELIEF_TEXTURE_DEPTH_SUMS, address(sums_.depths));
  bind(RELIEF_TEXTURE_ENVIRONMENT, frame.environment);
  if (frame.materials) {  // pixels ask their patches which one they have
    bind(RELIEF_TEXTURE_PATCH_IDS, address(frame.targets.patch_id));
    bind(RELIEF_TEXTURE_PATCHES, &variant_.samples.store().table.texture);
  }
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  for (const GLuint unit :
       {RELIEF_TEXTURE_NORMAL_SUMS, RELIEF_TEXTURE_COLOUR_SUMS, RELIEF_TEXTURE_DEPTH_SUMS,
        RELIEF_TEXTURE_ENVIRONMENT, RELIEF_TEXTURE_PATCH_IDS, RELIEF_TEXTURE_PATCHES})
    gl.BindTextureUnit(unit, 0);
  gl.BindVertexArray(0);
  gl.UseProgram(0);
  gl.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl.DepthMask(GL_TRUE);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.Disable(GL_DEPTH_TEST);
}

}  // namespace relief::multipass

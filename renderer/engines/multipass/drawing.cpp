#include "renderer/engines/multipass/drawing.h"

#include <utility>

#include "renderer/frame/targets/attachments.h"
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
  const SummingUp summing(gl, sums_, SumBlend::Add);
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
}

void Drawing::shade(const GlFrame& frame) const {
  // Of several materials pixels ask their patches which one they have.
  const bool mixed = frame.materials.has_value();
  draw_shading_pass(
      *variant_.gl, sums_, variant_.shading, variant_.nothing, frame.environment,
      {{RELIEF_TEXTURE_PATCH_IDS, mixed ? address(frame.targets.patch_id) : nullptr},
       {RELIEF_TEXTURE_PATCHES, mixed ? &variant_.samples.store().table.texture : nullptr}});
}

}  // namespace relief::multipass

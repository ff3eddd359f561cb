#include "renderer/engines/multipass/multipass.h"

#include <string>
#include <string_view>
#include <utility>

#include "renderer/frame/attachments.h"
#include "renderer/gl/program.h"
#include "renderer/view/draw_list.h"
#include "shaders/include/shared.h"

namespace relief::multipass {
namespace {

Result<SplatPrograms> make_programs(const Gl& gl, std::string_view pass, std::uint32_t features) {
  const auto make = [&](std::string_view shape, std::string_view label, std::uint32_t bits) {
    const std::string path = fmt::format("multipass/{}_{}", pass, shape);
    return make_program(gl, fmt::format("{}{}", label, pass), path + ".vert", path + ".frag", bits);
  };
  if ((features & RELIEF_FEATURE_SPRITE) == 0) {
    Result<Program> all = make("triangle", "", features);
    if (!all) return all.error();
    return SplatPrograms{std::move(*all), std::nullopt};
  }
  Result<Program> all = make("sprite", "", features);
  if (!all) return all.error();
  Result<Program> large = make(
      "triangle", "large ",
      (features & ~(RELIEF_FEATURE_SPRITE | RELIEF_FEATURE_FRONT)) | RELIEF_FEATURE_LARGE_SPRITES);
  if (!large) return large.error();
  return SplatPrograms{std::move(*all), std::move(*large)};
}

}  // namespace

Engine::Engine(const Gl& gl, const PatchStore& store, SplatPrograms visibility,
               SplatPrograms accumulation, Program shading)
    : gl_(&gl),
      samples_(gl, store),
      visibility_(std::move(visibility)),
      accumulation_(std::move(accumulation)),
      shading_(std::move(shading)),
      nothing_(gl, "no attributes") {}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  Result<SplatPrograms> visibility = make_programs(gl, "visibility", features);
  if (!visibility) return visibility.error();
  Result<SplatPrograms> accumulation = make_programs(gl, "accumulation", features);
  if (!accumulation) return accumulation.error();
  Result<Program> shading =
      make_program(gl, "shading", "environment/screen.vert", "multipass/shading.frag",
                   features & ~RELIEF_FEATURE_FRONT);
  if (!shading) return shading.error();
  return Engine(gl, store, std::move(*visibility), std::move(*accumulation), std::move(*shading));
}

void Engine::draw(const GlPicture& picture, const Sums& sums, double radius_factor,
                  PassTimer& timer) const {
  const PatchStore& store = samples_.store();
  const std::vector<std::uint32_t> visible = find_visible(store, picture.view, radius_factor);
  // The draws of both passes over the samples; the second, if there is one, of large sprites.
  std::vector<SampleDraw> draws;
  if (visibility_.large) {
    draws.push_back(
        samples_.make_draw(SampleShape::Points, by_sides(store, picture.view, visible)));
    const double widest = double{shared::kCoveringSlack} * radius_factor * widest_disc(store);
    const std::vector<std::uint32_t> near =
        find_near(store, picture.view, visible, widest, largest_sprite(*gl_));
    if (!near.empty()) {
      draws.push_back(
          samples_.make_draw(SampleShape::Triangles, by_sides(store, picture.view, near)));
    }
  } else {
    draws.push_back(
        samples_.make_draw(SampleShape::Triangles, by_sides(store, picture.view, visible)));
  }
  samples_.look(picture.view, visible);
  {
    const BoundModel bound(*gl_, samples_, nullptr);
    {
      const ScopedPass pass(*gl_, timer, "visibility");
      gl_->BindFramebuffer(GL_FRAMEBUFFER, sums.visibility.id());
      draw_splats(visibility_, draws, radius_factor);
    }
    if (has_any(sums)) {
      const ScopedPass pass(*gl_, timer, "accumulation");
      accumulate(sums, picture.targets.z_buffer, draws, radius_factor);
    }
  }
  {
    const ScopedPass pass(*gl_, timer, "shading");
    shade(picture, sums);
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
}

void Engine::draw_splats(const SplatPrograms& programs, const std::vector<SampleDraw>& draws,
                         double radius_factor) const {
  const auto run = [&](const Program& program, const SampleDraw& draw) {
    gl_->ProgramUniform1f(program.id(), RELIEF_UNIFORM_RADIUS_FACTOR,
                          static_cast<GLfloat>(radius_factor));
    samples_.draw(draw, program);
  };
  run(programs.all, draws.front());
  if (draws.size() > 1) run(*programs.large, draws.back());
}

void Engine::accumulate(const Sums& sums, const Texture& visible_depth,
                        const std::vector<SampleDraw>& draws, double radius_factor) const {
  clear_sums(*gl_, sums);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, sums.accumulation.id());
  gl_->DepthMask(GL_FALSE);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE);
  if (accumulation_.large) {
    // Sprites read the depth that is tested. Nothing writes it in this pass.
    gl_->TextureBarrier();
    gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, visible_depth.id());
  }
  draw_splats(accumulation_, draws, radius_factor);
  gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl_->BlendFunc(GL_ONE, GL_ZERO);
  gl_->Disable(GL_BLEND);
  gl_->DepthMask(GL_TRUE);
}

void Engine::shade(const GlPicture& picture, const Sums& sums) const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, sums.shading.id());
  gl_->Enable(GL_DEPTH_TEST);
  gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->DepthFunc(GL_LESS);  // the triangle is at 0, where what pass 1 covers is above
  gl_->DepthMask(GL_FALSE);
  gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->UseProgram(shading_.id());
  gl_->BindVertexArray(nothing_.id());
  const auto bind = [this](GLuint unit, const Texture* texture) {
    gl_->BindTextureUnit(unit, texture == nullptr ? 0 : texture->id());
  };
  bind(RELIEF_TEXTURE_NORMAL_SUMS, address(sums.normals));
  bind(RELIEF_TEXTURE_COLOUR_SUMS, address(sums.colours));
  bind(RELIEF_TEXTURE_DEPTH_SUMS, address(sums.depths));
  bind(RELIEF_TEXTURE_ENVIRONMENT, picture.environment);
  if (picture.materials) {  // pixels ask their patches which one they have
    bind(RELIEF_TEXTURE_PATCH_IDS, address(picture.targets.patch_id));
    bind(RELIEF_TEXTURE_PATCHES, &samples_.store().table.texture);
  }
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  for (const GLuint unit :
       {RELIEF_TEXTURE_NORMAL_SUMS, RELIEF_TEXTURE_COLOUR_SUMS, RELIEF_TEXTURE_DEPTH_SUMS,
        RELIEF_TEXTURE_ENVIRONMENT, RELIEF_TEXTURE_PATCH_IDS, RELIEF_TEXTURE_PATCHES})
    gl_->BindTextureUnit(unit, 0);
  gl_->BindVertexArray(0);
  gl_->UseProgram(0);
  gl_->Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->DepthMask(GL_TRUE);
  gl_->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl_->Disable(GL_DEPTH_TEST);
}

}  // namespace relief::multipass

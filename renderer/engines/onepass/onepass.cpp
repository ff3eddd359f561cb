#include "renderer/engines/onepass/onepass.h"

#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "renderer/engines/onepass/far_models.h"
#include "renderer/view/draw_list.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

Engine::Engine(const Gl& gl, const PatchStore& store, Programs programs)
    : gl_(&gl), samples_(gl, store, programs.rims.has_value()), programs_(std::move(programs)) {}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  Result<Programs> programs = make_programs(gl, store, features);
  if (!programs) return programs.error();
  return Engine(gl, store, std::move(*programs));
}

Engine::Frame Engine::make_frame(const View& view, const MaterialChoice& materials) const {
  return programs_.rims ? make_cell_frame(view, materials) : make_splat_frame(view);
}

Engine::Frame Engine::make_splat_frame(const View& view) const {
  const PatchStore& store = samples_.store();
  const std::vector<std::uint32_t> visible = find_visible(store, view);
  samples_.look(view, visible);
  Frame frame;
  if (!programs_.large_sprites) {
    frame.splats = samples_.make_draw(SampleShape::Quads, by_sides(store, view, visible));
    return frame;
  }
  frame.splats = samples_.make_draw(SampleShape::Points, by_sides(store, view, visible));
  const std::vector<std::uint32_t> near =
      find_near(store, view, visible, widest_disc(store), largest_sprite(*gl_));
  if (!near.empty())
    frame.large = samples_.make_draw(SampleShape::Quads, by_sides(store, view, near));
  return frame;
}

Engine::Frame Engine::make_cell_frame(const View& view, const MaterialChoice& materials) const {
  const PatchStore& store = samples_.store();
  const std::vector<std::uint32_t> parts = find_parts(store, view, materials);
  const std::vector<std::uint32_t> far = find_far(store, view);
  std::vector<std::uint32_t> looked_at;
  looked_at.reserve(parts.size() + far.size());
  for (const std::uint32_t part : parts) looked_at.push_back(store.cells->parts[part].patch);
  Frame frame;
  frame.cells = make_cell_draws(*gl_, *store.cells, parts_by_sides(store, view, parts));
  for (const std::uint32_t placement : far)
    looked_at.push_back(store.placements[placement].far->patch);
  frame.far_models = far_commands(store, view, far);
  samples_.look(view, looked_at);
  return frame;
}

void Engine::draw_patches(const Frame& frame) const {
  if (frame.cells) {
    draw_cells(*gl_, programs_, *frame.cells);
    return;
  }
  samples_.draw(*frame.splats, programs_.main);
  if (frame.large) samples_.draw(*frame.large, *programs_.large_sprites);
}

void Engine::draw_back(const GlPicture& picture, const Back& back, PassTimer& timer) const {
  const ScopedPass pass(*gl_, timer, "back");
  const Frame frame = make_cell_frame(back.view, back.materials);
  clear_back(*gl_, back);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, back.found.framebuffer.id());
  gl_->Viewport(0, 0, static_cast<GLsizei>(back.view.width),
                static_cast<GLsizei>(back.view.height));
  gl_->BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, back.uniforms.id());
  draw_cells(*gl_, programs_, *frame.cells, SeenFrom::Behind);
  gl_->BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, picture.uniforms.id());
  gl_->Viewport(0, 0, static_cast<GLsizei>(picture.targets.width),
                static_cast<GLsizei>(picture.targets.height));
  gl_->BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
}

void Engine::draw_far_models(const Frame& frame, PassTimer& timer) const {
  if (frame.far_models.empty()) return;
  const ScopedPass pass(*gl_, timer, "far models");
  draw_far(*gl_, *programs_.far, *samples_.store().far, frame.far_models);
}

void Engine::shade(const Program& shading, const Visibility& visibility,
                   const Texture& visible_depth) const {
  gl_->DepthFunc(GL_LESS);  // the triangle is at 0, where what was found is above
  gl_->DepthMask(GL_FALSE);
  gl_->UseProgram(shading.id());
  gl_->TextureBarrier();  // what is tested is read, too; nothing writes it in this pass
  gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, visible_depth.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND, visibility.places.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND_DEPTH, visibility.depths ? visibility.depths->id() : 0);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, 0);
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND, 0);
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND_DEPTH, 0);
  gl_->DepthMask(GL_TRUE);
  gl_->DepthFunc(GL_GREATER);
}

void Engine::draw(const GlPicture& picture, const Visibility* visibility, const Back* back,
                  const MaterialChoice& materials, PassTimer& timer) const {
  const BoundModel bound(*gl_, samples_, picture.environment);
  if (back != nullptr) draw_back(picture, *back, timer);
  const Frame frame = make_frame(picture.view, materials);
  if (!programs_.shading) {
    {
      const ScopedPass pass(*gl_, timer, "onepass");
      draw_patches(frame);
    }
    draw_far_models(frame, timer);
    return;
  }
  assert(visibility != nullptr && "a picture that is shaded later has a visibility buffer");
  {
    const ScopedPass pass(*gl_, timer, "visibility");
    gl_->BindFramebuffer(GL_FRAMEBUFFER, visibility->framebuffer.id());
    draw_patches(frame);
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
  {
    const ScopedPass pass(*gl_, timer, "shading");
    if (back != nullptr) bind_back(*gl_, *back, *samples_.store().bodies);
    shade(*programs_.shading, *visibility, picture.targets.z_buffer);
    if (back != nullptr) unbind_back(*gl_);
  }
  draw_far_models(frame, timer);
}

bool Engine::draw_layer(const GlPicture& picture, const Frame& frame, const Layer& layer,
                        const Layer& before, PassTimer& timer) const {
  const ScopedPass pass(*gl_, timer, "layer visibility");
  const GLfloat nothing = 0.0F;
  gl_->ClearNamedFramebufferfv(layer.visibility.framebuffer.id(), GL_DEPTH, 0, &nothing);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, layer.visibility.framebuffer.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, picture.targets.z_buffer.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, before.z_buffer.id());
  const Query found(*gl_, "layer", GLenum{GL_ANY_SAMPLES_PASSED});
  gl_->BeginQuery(GL_ANY_SAMPLES_PASSED, found.id());
  draw_patches(frame);
  gl_->EndQuery(GL_ANY_SAMPLES_PASSED);
  gl_->BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, 0);
  GLuint64 any = 0;
  gl_->GetQueryObjectui64v(found.id(), GL_QUERY_RESULT, &any);
  return any != 0;
}

void Engine::draw_over(const GlPicture& picture, const Layers& layers,
                       const MaterialChoice& materials, PassTimer& timer) const {
  const BoundModel bound(*gl_, samples_, picture.environment);
  const Frame frame = make_frame(picture.view, materials);
  const std::array<GLfloat, 4> zero{};
  const GLfloat nearest = 1.0F;
  gl_->ClearNamedFramebufferfv(layers.pair[0].shading.id(), GL_COLOR, 0, zero.data());
  gl_->ClearNamedFramebufferfv(layers.pair[1].visibility.framebuffer.id(), GL_DEPTH, 0, &nearest);
  for (std::size_t k = 0; k < kMostSurfaces; ++k) {
    const Layer& layer = layers.pair[k % 2];
    if (!draw_layer(picture, frame, layer, layers.pair[(k + 1) % 2], timer)) break;
    const ScopedPass pass(*gl_, timer, "layer shading");
    gl_->BindFramebuffer(GL_FRAMEBUFFER, (k == 0 ? layers.front : layer.shading).id());
    if (k > 0) gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);  // under what is in front
    shade(k == 0 ? *programs_.shading : *programs_.behind, layer.visibility, layer.z_buffer);
    gl_->Disable(GL_BLEND);
  }
  const ScopedPass pass(*gl_, timer, "over");
  gl_->BindFramebuffer(GL_FRAMEBUFFER, layers.over.id());
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->UseProgram(programs_.over->id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND, layers.colour.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->BindTextureUnit(RELIEF_TEXTURE_FOUND, 0);
  gl_->BlendFunc(GL_ONE, GL_ZERO);
  gl_->Disable(GL_BLEND);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
}

}  // namespace relief::onepass

#include "renderer/engines/onepass/onepass.h"

#include <utility>
#include <vector>

#include "renderer/draw_list.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

Engine::Engine(const Gl& gl, const PatchStore& store, Program program,
               std::optional<Program> large_sprites)
    : gl_(&gl),
      samples_(gl, store),
      program_(std::move(program)),
      large_sprites_(std::move(large_sprites)) {}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  if ((features & RELIEF_FEATURE_SPRITE) == 0) {
    Result<Program> quads =
        make_program(gl, "quads", "onepass/quad.vert", "onepass/quad.frag", features);
    if (!quads) return quads.error();
    return Engine(gl, store, std::move(*quads), std::nullopt);
  }
  Result<Program> sprites =
      make_program(gl, "sprites", "onepass/sprite.vert", "onepass/sprite.frag", features);
  if (!sprites) return sprites.error();
  Result<Program> large =
      make_program(gl, "large sprites", "onepass/large_sprite.vert", "onepass/quad.frag",
                   (features & ~RELIEF_FEATURE_SPRITE) | RELIEF_FEATURE_LARGE_SPRITES);
  if (!large) return large.error();
  return Engine(gl, store, std::move(*sprites), std::move(*large));
}

void Engine::draw(const View& view, PassTimer& timer, const Texture* environment) const {
  const PatchStore& store = samples_.store();
  const std::vector<std::uint32_t> visible = find_visible(store, view);
  const ScopedPass pass(*gl_, timer, "onepass");
  samples_.look(view, visible);
  const BoundModel bound(*gl_, samples_, environment);
  gl_->UseProgram(program_.id());
  if (!large_sprites_) {
    samples_.draw(samples_.make_draw(SampleShape::Quads, visible));
    return;
  }
  samples_.draw(samples_.make_draw(SampleShape::Points, visible));
  const std::vector<std::uint32_t> near =
      find_near(store, view, visible, widest_disc(store), largest_sprite(*gl_));
  if (near.empty()) return;
  gl_->UseProgram(large_sprites_->id());
  samples_.draw(samples_.make_draw(SampleShape::Quads, near));
}

}  // namespace relief::onepass

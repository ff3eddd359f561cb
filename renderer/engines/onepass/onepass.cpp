#include "renderer/engines/onepass/onepass.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>
#include <vector>

#include "renderer/draw_list.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

/// Of the features of a picture that is shaded later, those of the pass that finds the surface.
constexpr std::uint32_t kFindingFeatures =
    RELIEF_FEATURE_VISIBILITY | RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED |
    RELIEF_FEATURE_CORRECTED | RELIEF_FEATURE_OUT_DEPTH | RELIEF_FEATURE_POINT_LIGHTS |
    RELIEF_FEATURE_LAYERED | RELIEF_FEATURE_COUNT_FRAGMENTS | RELIEF_FEATURE_ORTHOGRAPHIC;

/// What the layers behind the first have nothing to say about.
constexpr std::uint32_t kOutputFeatures = RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH |
                                          RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH;

/// Nodes along the longest side of any patch or level.
std::uint32_t widest_side(const PatchStore& store) {
  std::uint32_t widest = 1;
  for (const StoredPatch& patch : store.patches) widest = std::max(widest, patch.side);
  return widest;
}

void bind_page(const Gl& gl, const CellPage& page) {
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_HEIGHTS, page.heights.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_ROWS, page.rows.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_RUNS, page.runs.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_RIMS, page.rims.texture.id());
}

}  // namespace

Engine::Engine(const Gl& gl, const PatchStore& store, Programs programs)
    : gl_(&gl), samples_(gl, store, programs.rims.has_value()), programs_(std::move(programs)) {}

Result<Engine::Programs> Engine::make_cell_programs(const Gl& gl, const PatchStore& store,
                                                    std::uint32_t features) {
  // What finds the surface needs nothing of what shades it.
  const bool shaded_later = (features & RELIEF_FEATURE_VISIBILITY) != 0;
  const std::uint32_t found = shaded_later ? features & kFindingFeatures : features;
  // A cell is the surface: there is nothing to correct.
  const std::uint32_t whole = found & ~RELIEF_FEATURE_MASKED;
  const std::uint32_t direct = ~RELIEF_FEATURE_CORRECTED;
  Result<Program> cells =
      make_program(gl, "cells", "onepass/cell.vert", "onepass/quad.frag", whole & direct);
  if (!cells) return cells.error();
  Result<Program> rims = make_program(gl, "rims", "onepass/quad.vert", "onepass/quad.frag", whole);
  if (!rims) return rims.error();
  Programs programs{std::move(*cells), std::nullopt, std::move(*rims), std::nullopt, std::nullopt};
  if (found != whole && store.masks) {
    Result<Program> edges =
        make_program(gl, "edges", "onepass/cell.vert", "onepass/quad.frag", found & direct);
    if (!edges) return edges.error();
    programs.edges = std::move(*edges);
  }
  if (!shaded_later) return programs;
  Result<Program> shading = make_program(
      gl, "shading", "environment/screen.vert", "onepass/shading.frag",
      features & ~(RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED | RELIEF_FEATURE_CORRECTED));
  if (!shading) return shading.error();
  programs.shading = std::move(*shading);
  if ((features & RELIEF_FEATURE_LAYERED) != 0) {
    Result<Program> behind =
        make_program(gl, "shading behind", "environment/screen.vert", "onepass/shading.frag",
                     features & ~(kOutputFeatures | RELIEF_FEATURE_CELL | RELIEF_FEATURE_MASKED |
                                  RELIEF_FEATURE_CORRECTED));
    if (!behind) return behind.error();
    programs.behind = std::move(*behind);
    Result<Program> over =
        make_program(gl, "over", "environment/screen.vert", "onepass/over.frag", 0);
    if (!over) return over.error();
    programs.over = std::move(*over);
  }
  const float steps = place_steps(widest_side(store));
  const auto tell = [&](const std::optional<Program>& program) {
    if (program) gl.ProgramUniform1f(program->id(), RELIEF_UNIFORM_PLACE_STEPS, steps);
  };
  gl.ProgramUniform1f(programs.main.id(), RELIEF_UNIFORM_PLACE_STEPS, steps);
  tell(programs.rims);
  tell(programs.edges);
  tell(programs.shading);
  tell(programs.behind);
  return programs;
}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  if ((features & RELIEF_FEATURE_CELL) != 0) {
    Result<Programs> programs = make_cell_programs(gl, store, features);
    if (!programs) return programs.error();
    return Engine(gl, store, std::move(*programs));
  }
  if ((features & RELIEF_FEATURE_SPRITE) == 0) {
    Result<Program> quads =
        make_program(gl, "quads", "onepass/quad.vert", "onepass/quad.frag", features);
    if (!quads) return quads.error();
    return Engine(gl, store, {std::move(*quads)});
  }
  Result<Program> sprites =
      make_program(gl, "sprites", "onepass/sprite.vert", "onepass/sprite.frag", features);
  if (!sprites) return sprites.error();
  Result<Program> large =
      make_program(gl, "large sprites", "onepass/large_sprite.vert", "onepass/quad.frag",
                   (features & ~RELIEF_FEATURE_SPRITE) | RELIEF_FEATURE_LARGE_SPRITES);
  if (!large) return large.error();
  return Engine(gl, store, {std::move(*sprites), std::move(*large)});
}

void Engine::draw_splats(const View& view) const {
  const PatchStore& store = samples_.store();
  const std::vector<std::uint32_t> visible = find_visible(store, view);
  samples_.look(view, visible);
  gl_->UseProgram(programs_.main.id());
  if (!programs_.large_sprites) {
    samples_.draw(samples_.make_draw(SampleShape::Quads, visible));
    return;
  }
  samples_.draw(samples_.make_draw(SampleShape::Points, visible));
  const std::vector<std::uint32_t> near =
      find_near(store, view, visible, widest_disc(store), largest_sprite(*gl_));
  if (near.empty()) return;
  gl_->UseProgram(programs_.large_sprites->id());
  samples_.draw(samples_.make_draw(SampleShape::Quads, near));
}

void Engine::draw_cells(const View& view, const MaterialChoice& materials) const {
  const CellStore& cells = *samples_.store().cells;
  const std::vector<std::uint32_t> visible = find_parts(samples_.store(), view, materials);
  std::vector<std::uint32_t> patches;
  patches.reserve(visible.size());
  for (const std::uint32_t part : visible) patches.push_back(cells.parts[part].patch);
  samples_.look(view, patches);
  gl_->UseProgram(programs_.main.id());
  for (std::uint32_t page = 0; page < cells.pages.size(); ++page)
    draw_strips(cells.pages[page], cell_commands(cells, visible, page));
  // What reaches beyond patches is mostly hidden by now.
  if (programs_.edges) {
    gl_->UseProgram(programs_.edges->id());
    for (std::uint32_t page = 0; page < cells.pages.size(); ++page)
      draw_strips(cells.pages[page], edge_commands(cells, visible, page));
  }
  gl_->UseProgram(programs_.rims->id());
  for (std::uint32_t page = 0; page < cells.pages.size(); ++page) {
    const std::vector<ElementsCommand> commands = rim_commands(cells, visible, page);
    if (commands.empty()) continue;
    const Buffer buffer =
        make_buffer(*gl_, "draw commands", std::span<const ElementsCommand>(commands));
    bind_page(*gl_, cells.pages[page]);
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
    gl_->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr,
                                   static_cast<GLsizei>(commands.size()), 0);
  }
}

void Engine::draw_strips(const CellPage& page, const std::vector<ArraysCommand>& commands) const {
  if (commands.empty()) return;
  const Buffer buffer =
      make_buffer(*gl_, "draw commands", std::span<const ArraysCommand>(commands));
  bind_page(*gl_, page);
  gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
  gl_->MultiDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr, static_cast<GLsizei>(commands.size()),
                               0);
}

void Engine::draw_model(const View& view, const MaterialChoice& materials) const {
  if (programs_.rims) {
    draw_cells(view, materials);
  } else {
    draw_splats(view);
  }
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

void Engine::draw(const GlPicture& picture, const Visibility* visibility,
                  const MaterialChoice& materials, PassTimer& timer) const {
  const BoundModel bound(*gl_, samples_, picture.environment);
  if (!programs_.shading) {
    const ScopedPass pass(*gl_, timer, "onepass");
    draw_model(picture.view, materials);
    return;
  }
  assert(visibility != nullptr && "a picture that is shaded later has a visibility buffer");
  {
    const ScopedPass pass(*gl_, timer, "visibility");
    gl_->BindFramebuffer(GL_FRAMEBUFFER, visibility->framebuffer.id());
    draw_model(picture.view, materials);
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, picture.targets.framebuffer.id());
  const ScopedPass pass(*gl_, timer, "shading");
  shade(*programs_.shading, *visibility, picture.targets.z_buffer);
}

bool Engine::draw_layer(const GlPicture& picture, const Layer& layer, const Layer& before,
                        const MaterialChoice& materials, PassTimer& timer) const {
  const ScopedPass pass(*gl_, timer, "layer visibility");
  const GLfloat nothing = 0.0F;
  gl_->ClearNamedFramebufferfv(layer.visibility.framebuffer.id(), GL_DEPTH, 0, &nothing);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, layer.visibility.framebuffer.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_VISIBLE_DEPTH, picture.targets.z_buffer.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, before.z_buffer.id());
  const Query found(*gl_, "layer", GLenum{GL_ANY_SAMPLES_PASSED});
  gl_->BeginQuery(GL_ANY_SAMPLES_PASSED, found.id());
  draw_model(picture.view, materials);
  gl_->EndQuery(GL_ANY_SAMPLES_PASSED);
  gl_->BindTextureUnit(RELIEF_TEXTURE_LAYER_DEPTH, 0);
  GLuint64 any = 0;
  gl_->GetQueryObjectui64v(found.id(), GL_QUERY_RESULT, &any);
  return any != 0;
}

void Engine::draw_over(const GlPicture& picture, const Layers& layers,
                       const MaterialChoice& materials, PassTimer& timer) const {
  const BoundModel bound(*gl_, samples_, picture.environment);
  const std::array<GLfloat, 4> zero{};
  const GLfloat nearest = 1.0F;
  gl_->ClearNamedFramebufferfv(layers.pair[0].shading.id(), GL_COLOR, 0, zero.data());
  gl_->ClearNamedFramebufferfv(layers.pair[1].visibility.framebuffer.id(), GL_DEPTH, 0, &nearest);
  for (std::size_t k = 0; k < kMostSurfaces; ++k) {
    const Layer& layer = layers.pair[k % 2];
    if (!draw_layer(picture, layer, layers.pair[(k + 1) % 2], materials, timer)) break;
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

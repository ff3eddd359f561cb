#include "renderer/engines/onepass/onepass.h"

#include <span>
#include <utility>
#include <vector>

#include "renderer/draw_list.h"
#include "renderer/engines/onepass/cell_list.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

void bind_page(const Gl& gl, const CellPage& page) {
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_HEIGHTS, page.heights.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_ROWS, page.rows.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_RUNS, page.runs.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_RIMS, page.rims.texture.id());
}

}  // namespace

Engine::Engine(const Gl& gl, const PatchStore& store, Programs programs)
    : gl_(&gl), samples_(gl, store, programs.rims.has_value()), programs_(std::move(programs)) {}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  if ((features & RELIEF_FEATURE_CELL) != 0) {
    // A cell is the surface: there is nothing to correct.
    const std::uint32_t whole = features & ~RELIEF_FEATURE_MASKED;
    const std::uint32_t direct = ~RELIEF_FEATURE_CORRECTED;
    Result<Program> cells =
        make_program(gl, "cells", "onepass/cell.vert", "onepass/quad.frag", whole & direct);
    if (!cells) return cells.error();
    Result<Program> rims =
        make_program(gl, "rims", "onepass/quad.vert", "onepass/quad.frag", whole);
    if (!rims) return rims.error();
    Engine engine(gl, store, {std::move(*cells), std::nullopt, std::move(*rims), std::nullopt});
    if (features == whole || !store.masks) return engine;
    Result<Program> edges =
        make_program(gl, "edges", "onepass/cell.vert", "onepass/quad.frag", features & direct);
    if (!edges) return edges.error();
    engine.programs_.edges = std::move(*edges);
    return engine;
  }
  if ((features & RELIEF_FEATURE_SPRITE) == 0) {
    Result<Program> quads =
        make_program(gl, "quads", "onepass/quad.vert", "onepass/quad.frag", features);
    if (!quads) return quads.error();
    return Engine(gl, store, {std::move(*quads), std::nullopt, std::nullopt, std::nullopt});
  }
  Result<Program> sprites =
      make_program(gl, "sprites", "onepass/sprite.vert", "onepass/sprite.frag", features);
  if (!sprites) return sprites.error();
  Result<Program> large =
      make_program(gl, "large sprites", "onepass/large_sprite.vert", "onepass/quad.frag",
                   (features & ~RELIEF_FEATURE_SPRITE) | RELIEF_FEATURE_LARGE_SPRITES);
  if (!large) return large.error();
  return Engine(gl, store, {std::move(*sprites), std::move(*large), std::nullopt, std::nullopt});
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

void Engine::draw_cells(const View& view) const {
  const CellStore& cells = *samples_.store().cells;
  const std::vector<std::uint32_t> visible = find_parts(samples_.store(), view);
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

void Engine::draw(const View& view, PassTimer& timer, const Texture* environment) const {
  const ScopedPass pass(*gl_, timer, "onepass");
  const BoundModel bound(*gl_, samples_, environment);
  if (programs_.rims) {
    draw_cells(view);
  } else {
    draw_splats(view);
  }
}

}  // namespace relief::onepass

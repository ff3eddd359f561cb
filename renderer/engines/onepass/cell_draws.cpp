#include "renderer/engines/onepass/cell_draws.h"

#include <cassert>
#include <span>

#include "renderer/engines/onepass/cell_list.h"
#include "renderer/view/draw_list.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

template <class Command>
std::optional<Commands> upload(const Gl& gl, const std::vector<Command>& commands) {
  if (commands.empty()) return std::nullopt;
  return Commands{make_buffer(gl, "draw commands", std::span<const Command>(commands)),
                  static_cast<GLsizei>(commands.size())};
}

void bind_page(const Gl& gl, const CellPage& page) {
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_HEIGHTS, page.heights.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_ROWS, page.rows.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_CELL_RUNS, page.runs.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_RIMS, page.rims.texture.id());
}

void draw_strips(const Gl& gl, const Program& program, const CellPage& page,
                 const std::optional<Commands>& strips) {
  if (!strips) return;
  gl.UseProgram(program.id());
  bind_page(gl, page);
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, strips->buffer.id());
  gl.MultiDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr, strips->count, 0);
}

}  // namespace

CellDraws make_cell_draws(const Gl& gl, const CellStore& store, const SidedList& parts) {
  CellDraws draws;
  for (std::uint32_t page = 0; page < store.pages.size(); ++page) {
    const auto add = [&](const std::vector<std::uint32_t>& list, bool front_alone) {
      if (list.empty()) return;
      draws.pages.push_back({&store.pages[page], front_alone,
                             upload(gl, cell_commands(store, list, page)),
                             upload(gl, edge_commands(store, list, page)),
                             upload(gl, rim_commands(store, list, page))});
    };
    add(parts.both, false);
    add(parts.front, true);
  }
  return draws;
}

void draw_cells(const Gl& gl, const Programs& programs, const CellDraws& draws, SeenFrom seen) {
  assert(programs.rims && "cells have border splats");
  const bool behind = seen == SeenFrom::Behind;
  // From the normals' side strips of cells are clockwise, because their first vertex is there
  // twice, and quads are not.
  gl.CullFace(behind ? GL_BACK : GL_FRONT);
  for (const CellDraws::Page& page : draws.pages) {
    const CulledFaces culled(gl, behind || page.front_alone);
    draw_strips(gl, programs.main, *page.page, page.cells);
  }
  for (const CellDraws::Page& page : draws.pages) {
    assert((programs.edges || !page.edges) && "what reaches beyond patches has its program");
    const CulledFaces culled(gl, behind || page.front_alone);
    if (page.edges) draw_strips(gl, *programs.edges, *page.page, page.edges);
  }
  gl.CullFace(behind ? GL_FRONT : GL_BACK);
  gl.UseProgram(programs.rims->id());
  for (const CellDraws::Page& page : draws.pages) {
    if (!page.rims) continue;
    const CulledFaces culled(gl, behind || page.front_alone);
    bind_page(gl, *page.page);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, page.rims->buffer.id());
    gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr, page.rims->count, 0);
  }
  gl.CullFace(GL_BACK);
}

}  // namespace relief::onepass

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

/// Triangles face as border splats do.
void draw_seams(const Gl& gl, const Programs& programs, const CellDraws& draws, bool behind) {
  if (draws.seams == nullptr) return;
  const auto samples = static_cast<GLuint>(get_limit(gl, GL_VERTEX_ARRAY_BINDING));
  gl.BindVertexArray(draws.seams->attributes.id());
  gl.UseProgram(programs.seams->id());
  gl.BindTextureUnit(RELIEF_TEXTURE_SEAM_VERTICES, draws.seams->vertices.texture.id());
  for (const auto member : {&CellDraws::seams_both, &CellDraws::seams_front}) {
    const std::optional<Commands>& commands = draws.*member;
    if (!commands) continue;
    const CulledFaces culled(gl, behind || member == &CellDraws::seams_front);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands->buffer.id());
    gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, commands->count, 0);
  }
  gl.BindTextureUnit(RELIEF_TEXTURE_SEAM_VERTICES, 0);
  gl.BindVertexArray(samples);
}

}  // namespace

CellDraws make_cell_draws(const Gl& gl, const CellStore& store, const SidedList& parts) {
  CellDraws draws;
  for (std::uint32_t page = 0; page < store.pages.size(); ++page) {
    const auto add = [&](const std::vector<std::uint32_t>& list, bool front_alone) {
      if (list.empty()) return;
      draws.pages.push_back({&store.pages[page], front_alone,
                             upload(gl, cell_commands(store, list, page, false)),
                             upload(gl, cell_commands(store, list, page, true)),
                             upload(gl, edge_commands(store, list, page)),
                             upload(gl, rim_commands(store, list, page))});
    };
    add(parts.both, false);
    add(parts.front, true);
  }
  return draws;
}

void add_seams(const Gl& gl, const PatchStore& store, const View& view, const SidedList& seams,
               SeenFrom seen, CellDraws& draws) {
  draws.seams = &*store.seams;
  draws.seams_both = upload(gl, seam_commands(store, view, seams.both, false));
  draws.seams_front =
      upload(gl, seam_commands(store, view, seams.front, seen == SeenFrom::Anywhere));
}

void draw_cells(const Gl& gl, const Programs& programs, const CellDraws& draws, SeenFrom seen) {
  assert(programs.rims && "cells have border splats");
  const bool behind = seen == SeenFrom::Behind;
  // From the normals' side strips of cells are clockwise, because their first vertex is there
  // twice, and quads are not.
  gl.CullFace(behind ? GL_BACK : GL_FRONT);
  const auto draw_strips = [&](std::optional<Commands> CellDraws::Page::*member,
                               const Program* program) {
    for (const CellDraws::Page& page : draws.pages) {
      const std::optional<Commands>& strips = page.*member;
      if (!strips) continue;
      assert(program != nullptr && "the store says which programs are needed");
      const CulledFaces culled(gl, behind || page.front_alone);
      gl.UseProgram(program->id());
      bind_page(gl, *page.page);
      gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, strips->buffer.id());
      gl.MultiDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr, strips->count, 0);
    }
  };
  draw_strips(&CellDraws::Page::cells, &programs.main);
  draw_strips(&CellDraws::Page::set_back, programs.set_back ? &*programs.set_back : &programs.main);
  draw_strips(&CellDraws::Page::edges, programs.edges ? &*programs.edges : nullptr);
  gl.CullFace(behind ? GL_FRONT : GL_BACK);
  gl.UseProgram(programs.rims->id());
  for (const CellDraws::Page& page : draws.pages) {
    if (!page.rims) continue;
    const CulledFaces culled(gl, behind || page.front_alone);
    bind_page(gl, *page.page);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, page.rims->buffer.id());
    gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr, page.rims->count, 0);
  }
  draw_seams(gl, programs, draws, behind);
  gl.CullFace(GL_BACK);
}

}  // namespace relief::onepass

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
  gl.BindTextureUnit(RELIEF_TEXTURE_BORDER_CELLS, page.borders.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_RIMS, page.rims.texture.id());
}

/// Binds another vertex array while it lives, then what was bound.
class BoundAttributes {
 public:
  BoundAttributes(const Gl& gl, const VertexArray& attributes)
      : gl_(gl), before_(static_cast<GLuint>(get_limit(gl, GL_VERTEX_ARRAY_BINDING))) {
    gl_.BindVertexArray(attributes.id());
  }
  ~BoundAttributes() { gl_.BindVertexArray(before_); }
  BoundAttributes(const BoundAttributes&) = delete;
  BoundAttributes& operator=(const BoundAttributes&) = delete;

 private:
  const Gl& gl_;
  GLuint before_;
};

/// As draw_seams.
void draw_strips(const Gl& gl, const Programs& programs, const CellDraws& draws, bool behind) {
  for (const CellDraws::Page& page : draws.pages) {
    if (!page.strips) continue;
    const CulledFaces culled(gl, behind || page.front_alone);
    const BoundAttributes attributes(gl, *page.page->attributes);
    gl.UseProgram(programs.main.id());
    bind_page(gl, *page.page);
    gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, page.strips->buffer.id());
    gl.MultiDrawElementsIndirect(GL_TRIANGLE_STRIP, GL_UNSIGNED_SHORT, nullptr, page.strips->count,
                                 0);
  }
}

/// Triangles face as border splats do.
void draw_seams(const Gl& gl, const Programs& programs, const CellDraws& draws, bool behind) {
  if (draws.seams == nullptr) return;
  const BoundAttributes attributes(gl, draws.seams->attributes);
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
}

}  // namespace

CellDraws make_cell_draws(const Gl& gl, const CellStore& store, const SidedList& parts) {
  CellDraws draws;
  const auto page_of = [&store](std::uint32_t part) { return store.parts[part].buffers.page; };
  const auto add = [&](const std::vector<std::uint32_t>& list, bool front_alone) {
    for (const auto& [page, share] : by_page(list, page_of)) {
      draws.pages.push_back(
          {&store.pages[page], front_alone, upload(gl, strip_commands(store, share)),
           upload(gl, run_commands(store, share)), upload(gl, edge_commands(store, share)),
           upload(gl, border_commands(store, share)), upload(gl, rim_commands(store, share))});
    }
  };
  add(parts.both, false);
  add(parts.front, true);
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
  gl.CullFace(behind ? GL_FRONT : GL_BACK);
  draw_strips(gl, programs, draws, behind);
  // From the normals' side runs are clockwise, because their first vertex is there twice, and
  // strips and quads are not.
  gl.FrontFace(GL_CW);
  const auto draw = [&](std::optional<Commands> CellDraws::Page::*member, const Program* program,
                        GLenum primitive) {
    for (const CellDraws::Page& page : draws.pages) {
      const std::optional<Commands>& runs = page.*member;
      if (!runs) continue;
      assert(program != nullptr && "the store says which programs are needed");
      const CulledFaces culled(gl, behind || page.front_alone);
      gl.UseProgram(program->id());
      bind_page(gl, *page.page);
      gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, runs->buffer.id());
      gl.MultiDrawArraysIndirect(primitive, nullptr, runs->count, 0);
    }
  };
  draw(&CellDraws::Page::runs, programs.runs ? &*programs.runs : &programs.main, GL_TRIANGLE_STRIP);
  draw(&CellDraws::Page::edges, programs.edges ? &*programs.edges : nullptr, GL_TRIANGLE_STRIP);
  gl.FrontFace(GL_CCW);
  draw(&CellDraws::Page::borders, programs.borders ? &*programs.borders : nullptr, GL_TRIANGLES);
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

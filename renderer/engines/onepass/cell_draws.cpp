#include "renderer/engines/onepass/cell_draws.h"

#include <cassert>
#include <limits>
#include <span>

#include "renderer/engines/onepass/cell_list.h"
#include "renderer/gl/drawing/draw_throttle.h"
#include "renderer/gl/software.h"
#include "renderer/view/draw_list.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

/// Uploads the lists of a frame, which may have hundreds of pages: what is asked of OpenGL is asked
/// once.
class CommandUpload {
 public:
  explicit CommandUpload(const Gl& gl)
      : gl_(gl),
        most_(draws_on_cpu(gl) ? kTrianglesPerFence : std::numeric_limits<std::uint64_t>::max()) {}

  template <class Command>
  std::optional<Commands> operator()(const std::vector<Command>& commands) const {
    if (commands.empty()) return std::nullopt;
    return Commands{make_buffer(gl_, "draw commands", std::span<const Command>(commands)),
                    slices_of(commands, most_)};
  }

 private:
  const Gl& gl_;
  std::uint64_t most_;  ///< triangles of a slice
};

/// How a multi-draw puts triangles together.
struct Assembly {
  GLenum mode = GL_TRIANGLES;
  GLenum indices = GL_NONE;  ///< their type; none: vertices in a row
};

void draw_commands(const Gl& gl, const Commands& commands, Assembly assembly,
                   DrawThrottle& throttle) {
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.buffer.id());
  const bool has_indices = assembly.indices != GL_NONE;
  const std::size_t bytes = has_indices ? sizeof(ElementsCommand) : sizeof(ArraysCommand);
  for (const Commands::Slice& slice : commands.slices) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset in the buffer, which OpenGL takes so
    const void* const first = reinterpret_cast<const void*>(bytes * slice.first);
    if (has_indices)
      gl.MultiDrawElementsIndirect(assembly.mode, assembly.indices, first, slice.count, 0);
    else
      gl.MultiDrawArraysIndirect(assembly.mode, first, slice.count, 0);
    throttle.drew(slice.triangles);
  }
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
void draw_strips(const Gl& gl, const Programs& programs, const CellDraws& draws, bool behind,
                 DrawThrottle& throttle) {
  for (const CellDraws::Page& page : draws.pages) {
    if (!page.strips) continue;
    const CulledFaces culled(gl, behind || page.front_alone);
    const BoundAttributes attributes(gl, *page.page->attributes);
    gl.UseProgram(programs.main.id());
    bind_page(gl, *page.page);
    draw_commands(gl, *page.strips, {GL_TRIANGLE_STRIP, GL_UNSIGNED_SHORT}, throttle);
  }
}

/// Triangles face as border splats do.
void draw_seams(const Gl& gl, const Programs& programs, const CellDraws& draws, bool behind,
                DrawThrottle& throttle) {
  if (draws.seams == nullptr) return;
  const BoundAttributes attributes(gl, draws.seams->attributes);
  gl.UseProgram(programs.seams->id());
  gl.BindTextureUnit(RELIEF_TEXTURE_SEAM_VERTICES, draws.seams->vertices.texture.id());
  for (const auto member : {&CellDraws::seams_both, &CellDraws::seams_front}) {
    const std::optional<Commands>& commands = draws.*member;
    if (!commands) continue;
    const CulledFaces culled(gl, behind || member == &CellDraws::seams_front);
    draw_commands(gl, *commands, {GL_TRIANGLES, GL_UNSIGNED_INT}, throttle);
  }
  gl.BindTextureUnit(RELIEF_TEXTURE_SEAM_VERTICES, 0);
}

}  // namespace

CellDraws make_cell_draws(const Gl& gl, const CellStore& store, const SidedList& parts) {
  CellDraws draws;
  const CommandUpload upload(gl);
  const auto page_of = [&store](std::uint32_t part) { return store.parts[part].buffers.page; };
  const auto add = [&](const std::vector<std::uint32_t>& list, bool front_alone) {
    for (const auto& [page, share] : by_page(list, page_of)) {
      draws.pages.push_back(
          {&store.pages[page], front_alone, upload(strip_commands(store, share)),
           upload(run_commands(store, share)), upload(edge_commands(store, share)),
           upload(border_commands(store, share)), upload(rim_commands(store, share))});
    }
  };
  add(parts.both, false);
  add(parts.front, true);
  return draws;
}

void add_seams(const Gl& gl, const PatchStore& store, const View& view, const SidedList& seams,
               SeenFrom seen, CellDraws& draws) {
  draws.seams = &*store.seams;
  const CommandUpload upload(gl);
  draws.seams_both = upload(seam_commands(store, view, seams.both, false));
  draws.seams_front = upload(seam_commands(store, view, seams.front, seen == SeenFrom::Anywhere));
}

void draw_cells(const Gl& gl, const Programs& programs, const CellDraws& draws, SeenFrom seen) {
  assert(programs.rims && "cells have border splats");
  const bool behind = seen == SeenFrom::Behind;
  DrawThrottle throttle(gl);
  gl.CullFace(behind ? GL_FRONT : GL_BACK);
  draw_strips(gl, programs, draws, behind, throttle);
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
      draw_commands(gl, *runs, {primitive}, throttle);
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
    draw_commands(gl, *page.rims, {GL_TRIANGLES, GL_UNSIGNED_SHORT}, throttle);
  }
  draw_seams(gl, programs, draws, behind, throttle);
  gl.CullFace(GL_BACK);
}

}  // namespace relief::onepass

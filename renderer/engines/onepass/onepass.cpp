#include "renderer/engines/onepass/onepass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "renderer/engines/onepass/cell_list.h"
#include "renderer/engines/onepass/draw_list.h"
#include "renderer/gl/program.h"
#include "shaders/include/shared.h"

namespace relief::onepass {
namespace {

/// Two triangles for each of kQuadsPerCommand quads, counter-clockwise seen from the normal's tip.
Buffer make_quad_corners(const Gl& gl) {
  std::vector<std::uint16_t> corners;
  corners.reserve(std::size_t{6} * kQuadsPerCommand);
  for (std::uint32_t quad = 0; quad < kQuadsPerCommand; ++quad) {
    for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U})
      corners.push_back(static_cast<std::uint16_t>(4 * quad + corner));
  }
  return make_buffer(gl, "quad corners", std::span<const std::uint16_t>(corners));
}

/// The vertex array: no vertex data but, per instance, the patch, and with `cells` its part's
/// corner.
VertexArray make_vertices(const Gl& gl, const PatchStore& store, bool cells,
                          const Buffer& quad_corners) {
  VertexArray vertices(gl, "samples");
  const GLuint id = vertices.id();
  const auto add_attribute = [&gl, id](GLuint location, GLuint offset) {
    gl.EnableVertexArrayAttrib(id, location);
    gl.VertexArrayAttribIFormat(id, location, 1, GL_UNSIGNED_INT, offset);
    gl.VertexArrayAttribBinding(id, location, 0);
  };
  gl.VertexArrayBindingDivisor(id, 0, 1);
  add_attribute(RELIEF_ATTRIBUTE_PATCH, 0);
  if (cells) {
    add_attribute(RELIEF_ATTRIBUTE_CORNER, sizeof(glm::uvec2::value_type));
    gl.VertexArrayVertexBuffer(id, 0, store.cells->places.id(), 0, sizeof(glm::uvec2));
  } else {
    gl.VertexArrayVertexBuffer(id, 0, store.indices.id(), 0, sizeof(std::uint32_t));
  }
  gl.VertexArrayElementBuffer(id, quad_corners.id());
  return vertices;
}

/// A sprite is at most as large as a disc of this radius (cells) that faces the eye from its
/// nearest point; patches farther than where that reaches OpenGL's limit need no large sprites.
double widest_disc(const PatchStore& store) {
  double widest = 0.0;
  for (const StoredPatch& patch : store.patches) widest = std::max(widest, patch.widest_disc);
  return widest;
}

}  // namespace

Engine::Engine(const Gl& gl, const PatchStore& store, std::uint32_t features, Programs programs)
    : gl_(&gl),
      store_(&store),
      features_(features),
      programs_(std::move(programs)),
      vertices_(gl, ""),
      quad_corners_(make_quad_corners(gl)),
      patch_views_(make_table(
          gl, "patch views", GL_RGBA32F,
          std::span<const shared::PatchView>(std::vector<shared::PatchView>(store.patches.size())),
          GL_DYNAMIC_STORAGE_BIT)) {
  vertices_ = make_vertices(gl, store, (features & RELIEF_FEATURE_CELL) != 0, quad_corners_);
  std::array<GLfloat, 2> range{};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  largest_sprite_ = range[1];
}

Result<Engine> Engine::create(const Gl& gl, const PatchStore& store, std::uint32_t features) {
  if ((features & RELIEF_FEATURE_CELL) != 0) {
    // A cell is the surface: there is nothing to correct.
    Result<Program> cells = make_program(gl, "cells", "onepass/cell.vert", "onepass/quad.frag",
                                         features & ~RELIEF_FEATURE_CORRECTED);
    if (!cells) return cells.error();
    Result<Program> rims =
        make_program(gl, "rims", "onepass/quad.vert", "onepass/quad.frag", features);
    if (!rims) return rims.error();
    return Engine(gl, store, features, {std::move(*cells), std::nullopt, std::move(*rims)});
  }
  if ((features & RELIEF_FEATURE_SPRITE) == 0) {
    Result<Program> quads =
        make_program(gl, "quads", "onepass/quad.vert", "onepass/quad.frag", features);
    if (!quads) return quads.error();
    return Engine(gl, store, features, {std::move(*quads), std::nullopt, std::nullopt});
  }
  Result<Program> sprites =
      make_program(gl, "sprites", "onepass/sprite.vert", "onepass/sprite.frag", features);
  if (!sprites) return sprites.error();
  Result<Program> large =
      make_program(gl, "large sprites", "onepass/large_sprite.vert", "onepass/quad.frag",
                   (features & ~RELIEF_FEATURE_SPRITE) | RELIEF_FEATURE_LARGE_SPRITES);
  if (!large) return large.error();
  return Engine(gl, store, features, {std::move(*sprites), std::move(*large), std::nullopt});
}

void Engine::bind_model(const Texture* environment) const {
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DepthFunc(GL_GREATER);
  gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_->Enable(GL_PROGRAM_POINT_SIZE);
  gl_->Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->BindVertexArray(vertices_.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_PATCHES, store_->table.texture.id());
  gl_->BindTextureUnit(RELIEF_TEXTURE_PATCH_VIEWS, patch_views_.texture.id());
  const auto bind = [this](GLuint unit, const Texture* texture) {
    if (texture != nullptr) gl_->BindTextureUnit(unit, texture->id());
  };
  bind(RELIEF_TEXTURE_HEIGHTS, store_->heights ? &*store_->heights : nullptr);
  bind(RELIEF_TEXTURE_NORMALS, store_->normals ? &*store_->normals : nullptr);
  bind(RELIEF_TEXTURE_COLOURS, store_->colours ? &*store_->colours : nullptr);
  bind(RELIEF_TEXTURE_ENVIRONMENT, environment);
}

void Engine::unbind_model() const {
  for (const GLuint unit :
       {RELIEF_TEXTURE_HEIGHTS, RELIEF_TEXTURE_NORMALS, RELIEF_TEXTURE_COLOURS,
        RELIEF_TEXTURE_ENVIRONMENT, RELIEF_TEXTURE_SAMPLES, RELIEF_TEXTURE_PATCHES,
        RELIEF_TEXTURE_PATCH_VIEWS, RELIEF_TEXTURE_CELL_HEIGHTS, RELIEF_TEXTURE_CELL_ROWS,
        RELIEF_TEXTURE_CELL_RUNS, RELIEF_TEXTURE_RIMS})
    gl_->BindTextureUnit(unit, 0);
  gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  gl_->BindVertexArray(0);
  gl_->UseProgram(0);
  gl_->Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_->Disable(GL_PROGRAM_POINT_SIZE);
  gl_->ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl_->DepthFunc(GL_LESS);
  gl_->Disable(GL_DEPTH_TEST);
}

void Engine::draw_points(const std::vector<std::uint32_t>& patches) const {
  for (std::uint32_t page = 0; page < store_->pages.size(); ++page) {
    const std::vector<ArraysCommand> commands = point_commands(*store_, patches, page);
    const Buffer buffer =
        make_buffer(*gl_, "draw commands", std::span<const ArraysCommand>(commands));
    gl_->BindTextureUnit(RELIEF_TEXTURE_SAMPLES, store_->pages[page].texture.id());
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
    gl_->MultiDrawArraysIndirect(GL_POINTS, nullptr, static_cast<GLsizei>(commands.size()), 0);
  }
}

void Engine::draw_quads(const std::vector<std::uint32_t>& patches) const {
  for (std::uint32_t page = 0; page < store_->pages.size(); ++page) {
    const std::vector<ElementsCommand> commands = quad_commands(*store_, patches, page);
    const Buffer buffer =
        make_buffer(*gl_, "draw commands", std::span<const ElementsCommand>(commands));
    gl_->BindTextureUnit(RELIEF_TEXTURE_SAMPLES, store_->pages[page].texture.id());
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
    gl_->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr,
                                   static_cast<GLsizei>(commands.size()), 0);
  }
}

void Engine::upload_views(const View& view, const std::vector<std::uint32_t>& patches) const {
  std::vector<shared::PatchView> views(store_->patches.size());
  for (const std::uint32_t p : patches) views[p] = view_patch(view, store_->patches[p]);
  if (views.empty()) return;
  gl_->NamedBufferSubData(patch_views_.buffer.id(), 0,
                          static_cast<GLsizeiptr>(views.size() * sizeof(shared::PatchView)),
                          views.data());
}

void Engine::draw_splats(const View& view) const {
  const std::vector<std::uint32_t> visible = find_visible(*store_, view);
  upload_views(view, visible);
  gl_->UseProgram(programs_.main.id());
  if (!programs_.large_sprites) {
    draw_quads(visible);
    return;
  }
  draw_points(visible);
  // A disc at depth z is at most 2 r / (z - r) / pixel wide, times sqrt(1 + slope^2) toward the
  // picture's corners.
  const double pixel = 2.0 * view.slope_y / view.height;
  const double lean = 1.0 + view.slope_x * view.slope_x + view.slope_y * view.slope_y;
  const double radius = widest_disc(*store_);
  const double reach = radius + 2.0 * radius * lean / (pixel * largest_sprite_);
  const std::vector<std::uint32_t> near = find_near(*store_, view, visible, reach);
  if (near.empty()) return;
  gl_->UseProgram(programs_.large_sprites->id());
  draw_quads(near);
}

void Engine::draw_cells(const View& view) const {
  const CellStore& cells = *store_->cells;
  const std::vector<std::uint32_t> visible = find_visible(cells, view);
  std::vector<std::uint32_t> patches;
  patches.reserve(visible.size());
  for (const std::uint32_t part : visible) patches.push_back(cells.parts[part].patch);
  upload_views(view, patches);
  const auto bind = [this](const CellPage& page) {
    gl_->BindTextureUnit(RELIEF_TEXTURE_CELL_HEIGHTS, page.heights.texture.id());
    gl_->BindTextureUnit(RELIEF_TEXTURE_CELL_ROWS, page.rows.texture.id());
    gl_->BindTextureUnit(RELIEF_TEXTURE_CELL_RUNS, page.runs.texture.id());
    gl_->BindTextureUnit(RELIEF_TEXTURE_RIMS, page.rims.texture.id());
  };
  gl_->UseProgram(programs_.main.id());
  for (std::uint32_t page = 0; page < cells.pages.size(); ++page) {
    const std::vector<ArraysCommand> commands = cell_commands(cells, visible, page);
    const Buffer buffer =
        make_buffer(*gl_, "draw commands", std::span<const ArraysCommand>(commands));
    bind(cells.pages[page]);
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
    gl_->MultiDrawArraysIndirect(GL_TRIANGLE_STRIP, nullptr, static_cast<GLsizei>(commands.size()),
                                 0);
  }
  // Set back in depth, the splats are mostly hidden by now.
  gl_->UseProgram(programs_.rims->id());
  for (std::uint32_t page = 0; page < cells.pages.size(); ++page) {
    const std::vector<ElementsCommand> commands = rim_commands(cells, visible, page);
    const Buffer buffer =
        make_buffer(*gl_, "draw commands", std::span<const ElementsCommand>(commands));
    bind(cells.pages[page]);
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
    gl_->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr,
                                   static_cast<GLsizei>(commands.size()), 0);
  }
}

void Engine::draw(const View& view, PassTimer& timer, const Texture* environment) const {
  const ScopedPass pass(*gl_, timer, "onepass");
  bind_model(environment);
  if (programs_.rims) {
    draw_cells(view);
  } else {
    draw_splats(view);
  }
  unbind_model();
}

}  // namespace relief::onepass

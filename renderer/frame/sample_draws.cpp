#include "renderer/frame/sample_draws.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <utility>

#include "renderer/store/patch_attributes.h"
#include "renderer/view/draw_list.h"
#include "renderer/view/uniforms.h"
#include "shaders/include/shared.h"

namespace relief {
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
  if (!cells) {
    return make_patch_attributes(gl, "samples", *store.indices, sizeof(std::uint32_t),
                                 quad_corners);
  }
  VertexArray vertices = make_patch_attributes(gl, "samples", store.cells->positions,
                                               sizeof(glm::uvec2), quad_corners);
  add_instance_attribute(gl, vertices, RELIEF_ATTRIBUTE_CORNER, sizeof(glm::uvec2::value_type));
  return vertices;
}

Table make_patch_views(const Gl& gl, const PatchStore& store) {
  const std::vector<shared::PatchView> views(store.patches.size());
  return make_table(gl, "patch views", GL_RGBA32F, std::span<const shared::PatchView>(views),
                    GL_DYNAMIC_STORAGE_BIT);
}

/// One page's commands in a buffer.
template <class Command>
SampleDraw::Page make_page(const Gl& gl, std::uint32_t number, const Table& records,
                           const std::vector<Command>& commands, bool front_alone) {
  return {number, records.texture.id(),
          make_buffer(gl, "draw commands", std::span<const Command>(commands)),
          static_cast<GLsizei>(commands.size()), front_alone};
}

}  // namespace

SampleDraws::SampleDraws(const Gl& gl, const PatchStore& store, bool cells)
    : gl_(&gl),
      store_(&store),
      cells_(cells),
      quad_corners_(make_quad_corners(gl)),
      vertices_(make_vertices(gl, store, cells, quad_corners_)),
      patch_views_(make_patch_views(gl, store)) {}

void SampleDraws::renew() {
  vertices_ = make_vertices(*gl_, *store_, cells_, quad_corners_);
  patch_views_ = make_patch_views(*gl_, *store_);
}

void SampleDraws::look(const View& view, const std::vector<std::uint32_t>& visible) const {
  if (visible.empty()) return;
  const auto [lowest, highest] = std::minmax_element(visible.begin(), visible.end());
  const std::uint32_t first = *lowest;
  std::vector<shared::PatchView> views(*highest + 1 - first);
  for (const std::uint32_t p : visible) views[p - first] = view_patch(view, store_->patches[p]);
  gl_->NamedBufferSubData(
      patch_views_.buffer.id(), static_cast<GLintptr>(first * sizeof(shared::PatchView)),
      static_cast<GLsizeiptr>(views.size() * sizeof(shared::PatchView)), views.data());
}

SampleDraw SampleDraws::make_draw(SampleShape shape, const SidedList& patches) const {
  SampleDraw draw{shape, {}};
  const auto page_of = [this](std::uint32_t patch) { return store_->patches[patch].records.page; };
  const auto add = [&](const std::vector<std::uint32_t>& list, bool front_alone) {
    for (const auto& [page, share] : by_page(list, page_of)) {
      const Table& records = store_->pages[page];
      if (shape == SampleShape::Quads) {
        draw.pages.push_back(
            make_page(*gl_, page, records, quad_commands(*store_, share), front_alone));
      } else {
        const std::uint32_t vertices = shape == SampleShape::Points ? 1 : 3;
        draw.pages.push_back(
            make_page(*gl_, page, records, array_commands(*store_, share, vertices), front_alone));
      }
    }
  };
  add(patches.both, false);
  add(patches.front, true);
  return draw;
}

void SampleDraws::draw(const SampleDraw& samples, const Program& program,
                       const PageTables& beside) const {
  const bool points = samples.shape == SampleShape::Points;
  // OpenGL knows no sides of points.
  const auto leave_backs_out = [&](bool leave_out) {
    if (points) {
      gl_->ProgramUniform1i(program.id(), RELIEF_UNIFORM_FRONT, leave_out ? 1 : 0);
    } else if (leave_out) {
      gl_->Enable(GL_CULL_FACE);
    } else {
      gl_->Disable(GL_CULL_FACE);
    }
  };
  gl_->UseProgram(program.id());
  for (const SampleDraw::Page& page : samples.pages) {
    if (page.front_alone) leave_backs_out(true);
    gl_->BindTextureUnit(RELIEF_TEXTURE_SAMPLES, page.records);
    if (beside.tables != nullptr)
      gl_->BindTextureUnit(beside.unit, (*beside.tables)[page.number].texture.id());
    gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, page.commands.id());
    if (samples.shape == SampleShape::Quads) {
      gl_->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr, page.count, 0);
    } else {
      gl_->MultiDrawArraysIndirect(samples.shape == SampleShape::Points ? GL_POINTS : GL_TRIANGLES,
                                   nullptr, page.count, 0);
    }
    if (page.front_alone) leave_backs_out(false);
  }
}

double largest_sprite(const Gl& gl) {
  std::array<GLfloat, 2> range{};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  return range[1];
}

BoundModel::BoundModel(const Gl& gl, const SampleDraws& samples, const Texture* environment)
    : gl_(gl) {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  gl_.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_.BindVertexArray(samples.vertices_.id());
  const PatchStore& store = samples.store();
  gl_.BindTextureUnit(RELIEF_TEXTURE_PATCHES, store.table.texture.id());
  gl_.BindTextureUnit(RELIEF_TEXTURE_PATCH_VIEWS, samples.patch_views_.texture.id());
  const auto bind = [this](GLuint unit, const Texture* texture) {
    if (texture != nullptr) gl_.BindTextureUnit(unit, texture->id());
  };
  bind(RELIEF_TEXTURE_HEIGHTS, store.heights ? &*store.heights : nullptr);
  bind(RELIEF_TEXTURE_NORMALS, store.normals ? &*store.normals : nullptr);
  bind(RELIEF_TEXTURE_COLOURS, store.colours ? &*store.colours : nullptr);
  bind(RELIEF_TEXTURE_MASKS, store.masks ? &*store.masks : nullptr);
  bind(RELIEF_TEXTURE_ENVIRONMENT, environment);
}

BoundModel::~BoundModel() {
  for (const GLuint unit :
       {RELIEF_TEXTURE_HEIGHTS, RELIEF_TEXTURE_NORMALS, RELIEF_TEXTURE_COLOURS,
        RELIEF_TEXTURE_ENVIRONMENT, RELIEF_TEXTURE_SAMPLES, RELIEF_TEXTURE_PATCHES,
        RELIEF_TEXTURE_PATCH_VIEWS, RELIEF_TEXTURE_CELL_HEIGHTS, RELIEF_TEXTURE_CELL_ROWS,
        RELIEF_TEXTURE_CELL_RUNS, RELIEF_TEXTURE_BORDER_CELLS, RELIEF_TEXTURE_RIMS,
        RELIEF_TEXTURE_MASKS})
    gl_.BindTextureUnit(unit, 0);
  gl_.BindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  gl_.BindVertexArray(0);
  gl_.UseProgram(0);
  gl_.Disable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  gl_.Disable(GL_PROGRAM_POINT_SIZE);
  gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_DEPTH_TEST);
}

}  // namespace relief

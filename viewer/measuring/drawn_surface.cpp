#include "viewer/measuring/drawn_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include "common/seams/cell_triangles.h"
#include "renderer/geometry/cells/border_cells.h"
#include "renderer/geometry/cells/cell_nodes.h"
#include "renderer/geometry/cells/patch_border.h"
#include "renderer/geometry/samples/samples.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Nodes around a range whose heights its splats depend on: reaches look one node further, at
/// slopes that look another one further, at borders beside their row. Border cells look as far: one
/// node beyond the range, and two about that.
constexpr std::uint32_t kMargin = 3;

/// A range with a margin, as far as the patch has nodes.
NodeRange widened(const Patch& patch, const NodeRange& range) {
  const glm::uvec2 end(patch.width - 1, patch.height - 1);
  return {range.first - glm::min(range.first, glm::uvec2(kMargin)),
          glm::min(range.last + kMargin, end)};
}

/// Adds the two triangles of a cell, halved along the diagonal from (0, 0) to (1, 1).
void add_cell(const Patch& patch, glm::uvec2 node, std::vector<GridTriangle>& triangles) {
  const double height_step = patch.height_step / patch.spacing;
  const auto corner = [&](std::uint32_t i, std::uint32_t j) {
    return glm::dvec3(node.x + i, node.y + j, patch.at(node.x + i, node.y + j) * height_step);
  };
  triangles.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
  triangles.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
}

std::uint32_t byte_of(std::uint32_t packed, std::uint32_t side) {
  return (packed >> (8 * side)) & 0xFFU;
}

/// Adds a splat's parallelogram, as shaders/include/splats.glsl has it (splat_corner).
void add_splat(const SampleRecord& record, std::uint32_t reach, double pixel,
               const PatchSamples& samples, glm::uvec2 first,
               std::vector<GridTriangle>& triangles) {
  const glm::dvec2 node(first + CellNodes::node_of(record));
  const glm::dvec3 centre(node, (record.shape & 0xFFFFU) * double{samples.height_step});
  const glm::i8vec2 steps(glm::u8vec2(record.shape >> 16U, record.shape >> 24U));
  const glm::dvec2 slope = double{samples.slope_step} * glm::dvec2(steps);
  const double margin = shared::kMarginPixels * pixel;
  const auto side = [reach, margin](std::uint32_t c) {
    return double{shared::kReachStep} * byte_of(reach, c) + margin;
  };
  const auto corner = [&](double x, double y) {
    return centre + glm::dvec3(x, y, x * slope.x + y * slope.y);
  };
  const glm::dvec3 low_left = corner(-side(0), -side(2));
  const glm::dvec3 high_right = corner(side(1), side(3));
  triangles.push_back({low_left, corner(side(1), -side(2)), high_right});
  triangles.push_back({low_left, high_right, corner(-side(0), side(3))});
}

/// Calls `visit` with the lower left node of each cell of a range, counted in the patch.
template <class Visit>
void for_each_cell(const NodeRange& range, const Visit& visit) {
  for (std::uint32_t j = range.first.y; j < range.last.y; ++j) {
    for (std::uint32_t i = range.first.x; i < range.last.x; ++i) visit(glm::uvec2(i, j));
  }
}

/// Calls `visit` with the lower left node of each cell that touches a range, those at the edge of
/// the patch included.
template <class Visit>
void for_each_touching_cell(const NodeRange& range, const Visit& visit) {
  const glm::i32vec2 first = glm::i32vec2(range.first) - 1;
  const glm::i32vec2 last(range.last);
  for (glm::i32vec2 cell = first; cell.y <= last.y; ++cell.y) {
    for (cell.x = first.x; cell.x <= last.x; ++cell.x) visit(cell);
  }
}

/// Adds the triangles of what a patch covers of a border cell; `first`: the node where its window
/// begins.
void add_polygon(const PatchBorder& border, const BorderPolygon& polygon, glm::uvec2 first,
                 std::vector<GridTriangle>& triangles) {
  const auto corner = [&](std::uint32_t c) {
    return glm::dvec3(glm::dvec2(first), 0.0) + border.position_of(polygon.corners[c]);
  };
  for (std::uint32_t c = 2; c < polygon.count; ++c)
    triangles.push_back({corner(0), corner(c - 1), corner(c)});
}

}  // namespace

glm::dvec3 grid_position(const Patch& patch, glm::dvec3 world) {
  return grid_direction(patch, world - patch.origin);
}

glm::dvec3 grid_direction(const Patch& patch, glm::dvec3 world) {
  return glm::transpose(patch.axes) * world / patch.spacing;
}

glm::dvec3 world_position(const Patch& patch, glm::dvec3 grid) {
  return patch.origin + patch.axes * (patch.spacing * grid);
}

std::optional<NodeRange> nodes_about(const Patch& patch, glm::dvec3 grid, double reach) {
  const glm::dvec2 most(patch.width - 1.0, patch.height - 1.0);
  const glm::dvec2 low = glm::max(glm::ceil(glm::dvec2(grid) - reach), 0.0);
  const glm::dvec2 high = glm::min(glm::floor(glm::dvec2(grid) + reach), most);
  if (!(low.x <= high.x && low.y <= high.y)) return std::nullopt;
  return NodeRange{glm::uvec2(low), glm::uvec2(high)};
}

Patch window_of(const Patch& patch, const NodeRange& range) {
  Patch window;
  window.origin = world_position(patch, glm::dvec3(glm::dvec2(range.first), 0.0));
  window.axes = patch.axes;
  window.spacing = patch.spacing;
  window.height_step = patch.height_step;
  window.width = range.last.x - range.first.x + 1;
  window.height = range.last.y - range.first.y + 1;
  const auto copy = [](const auto& from, std::size_t stride, glm::uvec2 first, std::uint32_t width,
                       std::uint32_t height, auto& to) {
    for (std::size_t j = first.y; j < std::size_t{first.y} + height; ++j) {
      const auto begin = from.begin() + static_cast<std::ptrdiff_t>(j * stride + first.x);
      to.insert(to.end(), begin, begin + width);
    }
  };
  copy(patch.heights, patch.width, range.first, window.width, window.height, window.heights);
  if (patch.normals.empty()) return window;
  const std::uint32_t scale = patch.normals.scale;
  window.normals = {scale * (window.width - 1) + 1, scale * (window.height - 1) + 1, scale, {}};
  copy(patch.normals.texels, patch.normals.width, scale * range.first, window.normals.width,
       window.normals.height, window.normals.texels);
  return window;
}

void add_cells(const Patch& patch, const NodeRange& range, bool joined, double pixel,
               DrawnTriangles& drawn) {
  const NodeRange wide = widened(patch, range);
  const Patch window = window_of(patch, wide);
  if (joined) {
    const CellTriangles cells = cell_triangles(window);
    for_each_cell(range, [&](glm::uvec2 node) {
      const glm::uvec2 own = node - wide.first;
      if (cells.at(own.x, own.y) == kWholeCell) add_cell(patch, node, drawn.cells);
    });
    return;
  }
  const PatchSamples samples = make_samples(window);
  const CellNodes nodes(window, samples);
  for_each_cell(range, [&](glm::uvec2 node) {
    if (nodes.is_cell(node - wide.first)) add_cell(patch, node, drawn.cells);
  });
  const PatchBorder border(window);
  for_each_touching_cell(range, [&](glm::i32vec2 cell) {
    border.for_each_polygon(cell - glm::i32vec2(wide.first), [&](const BorderPolygon& polygon) {
      add_polygon(border, polygon, wide.first, drawn.splats);
    });
  });
  for (const SampleRecord& record : samples.records) {
    const glm::uvec2 node = wide.first + CellNodes::node_of(record);
    const bool within = glm::all(glm::lessThanEqual(range.first, node)) &&
                        glm::all(glm::lessThanEqual(node, range.last));
    if (!within) continue;
    if (const auto reach = rim_reach(nodes, border, record))
      add_splat(record, *reach, pixel, samples, wide.first, drawn.splats);
  }
}

void add_seams(const Patch& patch, const Seams& seams, std::uint32_t share, glm::dvec3 about,
               double reach, DrawnTriangles& drawn) {
  const double height_step = patch.height_step / patch.spacing;
  const auto corner = [&](std::uint32_t number) {
    if ((number & kSeamVertexBit) != 0)
      return grid_position(patch, seams.vertices[number & ~kSeamVertexBit].position);
    return glm::dvec3(number % patch.width, number / patch.width,
                      patch.heights[number] * height_step);
  };
  for (const Triangle& t : seams.triangles[share]) {
    const GridTriangle triangle{corner(t[0]), corner(t[1]), corner(t[2])};
    const glm::dvec3 low = glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
    const glm::dvec3 high = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]);
    if (glm::all(glm::lessThanEqual(low, about + reach)) &&
        glm::all(glm::greaterThanEqual(high, about - reach)))
      drawn.cells.push_back(triangle);
  }
}

}  // namespace relief

#include "renderer/geometry/cells/border_cells.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "shaders/include/shared.h"

namespace relief {
namespace {

/// How far a border cell's polygon is set back, in steps: as the border splats of its samples are.
std::uint32_t set_back_of(const BorderPolygon& polygon, const CellNodes& nodes) {
  float steepest = 0.0F;
  for (const BorderCorner& corner : std::span(polygon.corners).first(polygon.count))
    steepest = std::max(steepest, nodes.steepness(nodes.index(glm::uvec2(corner.node))));
  return std::min(set_back_steps(steepest), 255U);
}

/// Packs a polygon of a cell in the part that begins at `corner`.
BorderCell border_cell(const BorderPolygon& polygon, glm::i32vec2 cell, glm::uvec2 corner,
                       std::uint32_t set_back) {
  const glm::uvec2 position(cell + 1 - glm::i32vec2(corner));
  BorderCell packed;
  packed.cell = position.x | (position.y << shared::kNodeInPartBits) |
                (std::uint32_t{polygon.slots} << shared::kBorderSlotsShift) |
                (set_back << shared::kBorderSetBackShift);
  std::uint32_t next = 0;
  for (std::uint32_t slot = 0; slot < 8; ++slot) {
    if (((polygon.slots >> slot) & 1U) == 0) continue;
    const float way = polygon.corners[next++].way;
    if (slot % 2 == 1)
      packed.ways |= static_cast<std::uint32_t>(std::lround(way / shared::kBorderStep))
                     << (8 * (slot / 2));
  }
  return packed;
}

/// Makes a part's sphere hold a polygon, and its normals those of it.
void hold(const PatchBorder& border, const BorderPolygon& polygon, CellPart& part) {
  std::array<glm::dvec3, BorderPolygon::kMost> at;
  for (std::uint32_t c = 0; c < polygon.count; ++c) {
    at[c] = border.position_of(polygon.corners[c]);
    part.radius = std::max(part.radius, glm::distance(at[c], part.centre));
    if (c >= 2) part.normals.add(glm::vec3(glm::cross(at[c - 1] - at[0], at[c] - at[0])));
  }
}

}  // namespace

void add_border_cells(const Patch& patch, const PatchBorder& border, const CellNodes& nodes,
                      PatchCells& cells) {
  border.for_each_polygon([&](glm::i32vec2 cell, const BorderPolygon& polygon) {
    CellPart& part = cells.parts[part_at(patch, glm::uvec2(glm::max(cell, glm::i32vec2(0))))];
    part.borders.push_back(border_cell(polygon, cell, part.corner, set_back_of(polygon, nodes)));
    hold(border, polygon, part);
  });
}

std::uint32_t set_back_steps(float steepness) {
  return static_cast<std::uint32_t>(
      std::lround(shared::kBorderSetBack * steepness / shared::kSetBackStep));
}

std::optional<std::uint32_t> rim_reach(const CellNodes& nodes, const PatchBorder& border,
                                       const SampleRecord& record) {
  assert(((record.node & shared::kBorderBit) == 0 || record.gap == 0) &&
         "margins of border splats are in their reaches");
  const bool jump = border.beside_jump(glm::i32vec2(CellNodes::node_of(record)));
  if (!jump && nodes.off_edges(record) <= shared::kCrease) return {};
  return nodes.closed_reach(record, jump);
}

}  // namespace relief

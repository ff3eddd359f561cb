// Where the surface of a patch ends: along a smooth curve between its samples and its holes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/patch.h"

namespace relief {

/// A corner of a patch's surface in a border cell: a node of the cell, or a position on one of its
/// edges.
struct BorderCorner {
  glm::i32vec2 node{0};    ///< a sample
  glm::i32vec2 toward{0};  ///< the hole beside it that the edge runs to; `node` itself for a node
  float way = 0.0F;        ///< how far to go there along the surface, in cells
};

/// The part of a patch's surface in a cell that has samples and holes at its corners. Convex,
/// counterclockwise about the patch's normal.
struct BorderPolygon {
  static constexpr std::uint32_t kMost = 5;
  std::uint32_t count = 0;  ///< of its corners, 3 to 5
  std::array<BorderCorner, kMost> corners{};
  /// Its corners among the nodes and edges of the cell, as bits: node 00, the edge on to node 10,
  /// that node, and on about the cell.
  std::uint8_t slots = 0;
};

/// The border of a patch that overlaps others. A mean over 5x5 nodes (binomial weights) of what
/// is sample and what is hole falls through a half there, as marching squares follow it ([Lorensen
/// 1987] in the plane): half-way from sample to hole along straight rows of samples, and without
/// their steps along all others. No sample lies beyond it, and no hole before it.
class PatchBorder {
 public:
  /// `patch` outlives this.
  explicit PatchBorder(const Patch& patch) : patch_(patch) {}

  /// Nodes may lie outside of the patch, where there are holes.
  [[nodiscard]] bool is_sample(glm::i32vec2 node) const;

  /// The mean at a node, 0 to 1: at samples more than a half, at holes less.
  [[nodiscard]] float mean_at(glm::i32vec2 node) const;

  /// Calls `visit` with each polygon of a cell, `cell` its lower left node; from -1 on and up to
  /// the last node of the patch. None if the cell has no hole, no sample, or samples that jump to
  /// another sheet.
  template <class Visit>
  void for_each_polygon(glm::i32vec2 cell, const Visit& visit) const {
    const std::uint32_t samples = samples_of(cell);
    if (samples == 0 || samples == 0xFU || jumps(cell)) return;
    constexpr std::uint32_t kDiagonal = 0b0101;
    if (samples == kDiagonal || samples == (kDiagonal << 1U)) {
      // Two that do not touch.
      for (std::uint32_t corner = samples == kDiagonal ? 0 : 1; corner < 4; corner += 2)
        visit(polygon(cell, 1U << corner));
    } else {
      visit(polygon(cell, samples));
    }
  }

  /// Calls `visit` with each cell that has polygons, row by row, and each of them.
  template <class Visit>
  void for_each_polygon(const Visit& visit) const {
    const glm::i32vec2 end(patch_.width, patch_.height);
    for (glm::i32vec2 cell(-1); cell.y < end.y; ++cell.y) {
      for (cell.x = -1; cell.x < end.x; ++cell.x)
        for_each_polygon(cell, [&](const BorderPolygon& polygon) { visit(cell, polygon); });
    }
  }

  /// Whether one of the cells at a node jumps to another sheet.
  [[nodiscard]] bool beside_jump(glm::i32vec2 node) const;

  /// A corner in the grid frame: a position on an edge continues the slope to its sample.
  [[nodiscard]] glm::dvec3 position_of(const BorderCorner& corner) const;

 private:
  [[nodiscard]] std::uint32_t samples_of(glm::i32vec2 cell) const;
  [[nodiscard]] bool jumps(glm::i32vec2 cell) const;
  [[nodiscard]] bool has_cell(glm::i32vec2 node) const;
  [[nodiscard]] BorderPolygon polygon(glm::i32vec2 cell, std::uint32_t samples) const;
  [[nodiscard]] BorderCorner crossing(glm::i32vec2 sample, glm::i32vec2 hole) const;
  [[nodiscard]] double height(glm::i32vec2 node) const;

  const Patch& patch_;
};

}  // namespace relief

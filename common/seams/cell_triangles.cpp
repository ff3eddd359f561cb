#include "common/seams/cell_triangles.h"

#include <tbb/parallel_for.h>

#include <cstdlib>

namespace relief {

CellTriangles cell_triangles(const Patch& patch) {
  CellTriangles cells;
  if (patch.width < 2 || patch.height < 2) return cells;
  cells.columns = patch.width - 1;
  cells.rows = patch.height - 1;
  cells.bits.resize(std::size_t{cells.columns} * cells.rows, 0);
  const double largest_rise = kSteepestJoined * patch.spacing / patch.height_step;
  const auto joined = [largest_rise](std::int32_t a, std::int32_t b) {
    return a != kHole && b != kHole && std::abs(b - a) <= largest_rise;
  };
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      const std::int32_t h00 = patch.at(i, j);
      const std::int32_t h10 = patch.at(i + 1, j);
      const std::int32_t h01 = patch.at(i, j + 1);
      const std::int32_t h11 = patch.at(i + 1, j + 1);
      const bool bottom = joined(h00, h10);
      const bool right = joined(h10, h11);
      const bool left = joined(h00, h01);
      const bool top = joined(h01, h11);
      std::uint8_t bits = 0;
      if (bottom && right) bits |= kLowerTriangle;
      if (left && top) bits |= kUpperTriangle;
      if (h00 == kHole && right && top) bits |= kWithoutFirst;
      if (h11 == kHole && bottom && left) bits |= kWithoutLast;
      cells.bits[std::size_t{j} * cells.columns + i] = bits;
    }
  }
  return cells;
}

std::vector<CellTriangles> cell_triangles(std::span<const Patch> patches) {
  std::vector<CellTriangles> cells(patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(),
                    [&](std::size_t p) { cells[p] = cell_triangles(patches[p]); });
  return cells;
}

}  // namespace relief

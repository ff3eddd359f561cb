// The triangles of a patch's own cells, where its border may meet that of another patch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/patch.h"

namespace relief {

/// Patches that meet at seams have no edge that rises by more than this, in cells: steeper ones are
/// left to patches that see them less askew.
inline constexpr double kSteepestJoined = 3.0;

/// Triangles of a cell, as bits. The corners are named by column and row: 00, 10, 11, 01.
inline constexpr std::uint8_t kLowerTriangle = 1;  ///< 00, 10, 11
inline constexpr std::uint8_t kUpperTriangle = 2;  ///< 00, 11, 01
inline constexpr std::uint8_t kWithoutFirst = 4;   ///< 10, 11, 01: there is no sample at 00
inline constexpr std::uint8_t kWithoutLast = 8;    ///< 00, 10, 01: there is none at 11
inline constexpr std::uint8_t kWholeCell = kLowerTriangle | kUpperTriangle;

/// The cells of a patch: (width - 1) * (height - 1), row by row, each the bits of its triangles.
/// A cell with four samples is halved along the diagonal from 00 to 11.
struct CellTriangles {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<std::uint8_t> bits;

  /// 0 outside of the grid.
  [[nodiscard]] std::uint8_t at(std::uint32_t i, std::uint32_t j) const {
    return i < columns && j < rows ? bits[std::size_t{j} * columns + i] : std::uint8_t{0};
  }
};

/// Whether the cells around a node are whole, all four.
[[nodiscard]] inline bool is_surrounded(const CellTriangles& cells, std::uint32_t i,
                                        std::uint32_t j) {
  // i - 1 and j - 1 of the first wrap around to what is outside.
  return cells.at(i, j) == kWholeCell && cells.at(i - 1, j) == kWholeCell &&
         cells.at(i, j - 1) == kWholeCell && cells.at(i - 1, j - 1) == kWholeCell;
}

[[nodiscard]] CellTriangles cell_triangles(const Patch& patch);

/// The cells of each of some patches.
[[nodiscard]] std::vector<CellTriangles> cell_triangles(std::span<const Patch> patches);

/// Calls `visit` with the node indices of each triangle of a cell, counterclockwise about the
/// patch's normal.
template <class Visit>
void for_each_triangle(const Patch& patch, const CellTriangles& cells, std::uint32_t i,
                       std::uint32_t j, const Visit& visit) {
  const std::uint8_t bits = cells.at(i, j);
  const std::uint32_t n00 = j * patch.width + i;
  const std::uint32_t n10 = n00 + 1;
  const std::uint32_t n01 = n00 + patch.width;
  const std::uint32_t n11 = n01 + 1;
  using Corners = std::array<std::uint32_t, 3>;
  if ((bits & kLowerTriangle) != 0) visit(Corners{n00, n10, n11});
  if ((bits & kUpperTriangle) != 0) visit(Corners{n00, n11, n01});
  if ((bits & kWithoutFirst) != 0) visit(Corners{n10, n11, n01});
  if ((bits & kWithoutLast) != 0) visit(Corners{n00, n10, n01});
}

}  // namespace relief

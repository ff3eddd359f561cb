#include "renderer/cells.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/padded_heights.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Whether node (i, j) is the lower left of a cell with four samples.
bool is_cell(const PaddedHeights& heights, std::uint32_t i, std::uint32_t j) {
  const std::size_t k = heights.index(i, j);
  const std::size_t above = k + heights.stride();
  return heights.valid(k) && heights.valid(k + 1) && heights.valid(above) &&
         heights.valid(above + 1);
}

/// Appends a row of nodes.
void add_row(const Patch& patch, std::uint32_t j, PatchCells& cells) {
  std::uint32_t first = 0;
  while (first < patch.width && patch.at(first, j) == kHole) ++first;
  std::uint32_t end = patch.width;
  while (end > first && patch.at(end - 1, j) == kHole) --end;
  // Before the first height this is below 0, which adding the column takes back.
  cells.rows.push_back({static_cast<std::uint32_t>(cells.heights.size()) - first,
                        first | (end << 16U)});
  for (std::uint32_t i = first; i < end; ++i) {
    const std::int32_t height = patch.at(i, j);
    cells.heights.push_back(
        static_cast<std::uint16_t>(height == kHole ? shared::kHoleTexel : height));
  }
}

/// Appends the runs of a part's cells in row j, which end before column `end`.
void add_runs(const PaddedHeights& heights, glm::uvec2 corner, std::uint32_t j, std::uint32_t end,
              std::vector<std::uint32_t>& runs) {
  std::uint32_t i = corner.x;
  while (i < end) {
    const std::uint32_t first = i;
    while (i < end && i - first < shared::kRunCells && is_cell(heights, i, j)) ++i;
    if (i > first) {
      runs.push_back((first - corner.x) | ((j - corner.y) << shared::kPlaceBits) |
                     ((i - first) << (2 * shared::kPlaceBits)));
    } else {
      ++i;
    }
  }
}

/// A part without its rims; its sphere is about its nodes, one cell more than its own each way.
CellPart make_part(const Patch& patch, const PaddedHeights& heights, glm::uvec2 corner,
                   double height_step) {
  CellPart part;
  part.corner = corner;
  const glm::uvec2 end = glm::min(corner + shared::kPartCells, {patch.width, patch.height});
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = corner.y; j < end.y; ++j) add_runs(heights, corner, j, end.x, part.runs);
  for (std::uint32_t j = corner.y; j < std::min(end.y + 1, patch.height); ++j) {
    for (std::uint32_t i = corner.x; i < std::min(end.x + 1, patch.width); ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 p(i, j, patch.at(i, j) * height_step);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  if (low.x > high.x) return part;
  part.centre = 0.5 * (low + high);
  part.radius = 0.5 * glm::length(high - low);
  return part;
}

}  // namespace

PatchCells make_cells(const Patch& patch, const PatchSamples& samples) {
  assert(patch.width <= kMaxPatchSide && patch.height <= kMaxPatchSide && "as its type says");
  static_assert(shared::kPartCells + 1 <= 1U << shared::kPlaceBits &&
                    shared::kPartCells % shared::kRunCells == 0,
                "places of a part fit their bits, and no run is cut but by holes");
  PatchCells cells;
  for (std::uint32_t j = 0; j < patch.height; ++j) add_row(patch, j, cells);
  cells.rows.push_back({});

  const PaddedHeights heights(patch);
  const glm::uvec2 counts = (glm::uvec2(patch.width, patch.height) + (shared::kPartCells - 1)) /
                            shared::kPartCells;
  for (std::uint32_t y = 0; y < counts.y; ++y) {
    for (std::uint32_t x = 0; x < counts.x; ++x) {
      cells.parts.push_back(make_part(patch, heights, glm::uvec2(x, y) * shared::kPartCells,
                                      samples.height_step));
    }
  }
  for (const SampleRecord& record : samples.records) {
    if ((record.place & shared::kBorderBit) == 0) continue;
    assert(record.gap == 0 && "margins of border splats are in their reaches");
    const glm::uvec2 node(record.place & shared::kNodeMask,
                          (record.place >> shared::kRowShift) & shared::kNodeMask);
    const glm::uvec2 part = node / shared::kPartCells;
    const glm::uvec2 place = node - part * shared::kPartCells;
    cells.parts[std::size_t{part.y} * counts.x + part.x].rims.push_back(
        {place.x | (place.y << shared::kPlaceBits) | (record.shape & 0xFFFF0000U), record.reach});
  }
  std::erase_if(cells.parts,
                [](const CellPart& part) { return part.runs.empty() && part.rims.empty(); });
  for (CellPart& part : cells.parts) {
    if (!part.rims.empty()) part.radius += samples.widest_disc;
  }
  return cells;
}

}  // namespace relief

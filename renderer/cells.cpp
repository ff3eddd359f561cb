#include "renderer/cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/ext/vector_uint2_sized.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/padded_heights.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// The samples of a patch with their splats, by padded index.
class Nodes {
 public:
  Nodes(const Patch& patch, const PatchSamples& samples)
      : heights_(patch), samples_(samples), records_(heights_.size(), nullptr) {
    for (const SampleRecord& record : samples.records) records_[index(place_of(record))] = &record;
  }

  [[nodiscard]] static glm::uvec2 place_of(const SampleRecord& record) {
    return {record.place & shared::kNodeMask,
            (record.place >> shared::kRowShift) & shared::kNodeMask};
  }

  [[nodiscard]] std::size_t index(glm::uvec2 node) const { return heights_.index(node.x, node.y); }

  /// Whether a node is the lower left of a cell with four samples.
  [[nodiscard]] bool is_cell(glm::uvec2 node) const {
    const std::size_t k = index(node);
    const std::size_t above = k + heights_.stride();
    return heights_.valid(k) && heights_.valid(k + 1) && heights_.valid(above) &&
           heights_.valid(above + 1);
  }

  [[nodiscard]] bool is_border(std::size_t k) const {
    return (records_[k]->place & shared::kBorderBit) != 0;
  }

  /// One over the cosine of a splat's tilt.
  [[nodiscard]] float steepness(std::size_t k) const {
    const glm::vec2 slope = slope_of(*records_[k]);
    return std::sqrt(1.0F + glm::dot(slope, slope));
  }

  /// How far a splat's plane is off the edges of the cells beside it where it ends (cells, along
  /// its normal).
  [[nodiscard]] float off_edges(const SampleRecord& record) const {
    const std::size_t k = index(place_of(record));
    const glm::vec2 slope = slope_of(record);
    float most = 0.0F;
    for (const glm::length_t side : {0, 1, 2, 3}) {
      const std::size_t step = side < 2 ? 1 : heights_.stride();
      const bool forward = side % 2 == 1;
      const std::size_t next = forward ? k + step : k - step;
      if (!heights_.valid(next)) continue;
      const float rise = samples_.height_step * static_cast<float>(heights_[next] - heights_[k]);
      const float reach =
          shared::kReachStep * static_cast<float>((record.reach >> (8 * side)) & 0xFFU);
      const float run = forward ? slope[side / 2] : -slope[side / 2];
      most = std::max(most, reach * std::abs(run - rise));
    }
    return most / steepness(k);
  }

 private:
  [[nodiscard]] glm::vec2 slope_of(const SampleRecord& record) const {
    const glm::i8vec2 steps(glm::u8vec2(record.shape >> 16U, record.shape >> 24U));
    return samples_.slope_step * glm::vec2(steps);
  }

  PaddedHeights heights_;
  const PatchSamples& samples_;
  std::vector<const SampleRecord*> records_;  ///< null: a hole
};

/// Appends a row of nodes.
void add_row(const Patch& patch, std::uint32_t j, PatchCells& cells) {
  std::uint32_t first = 0;
  while (first < patch.width && patch.at(first, j) == kHole) ++first;
  std::uint32_t end = patch.width;
  while (end > first && patch.at(end - 1, j) == kHole) --end;
  // Before the first height this is below 0, which adding the column takes back.
  cells.rows.push_back(
      {static_cast<std::uint32_t>(cells.heights.size()) - first, first | (end << 16U)});
  for (std::uint32_t i = first; i < end; ++i) {
    const std::int32_t height = patch.at(i, j);
    cells.heights.push_back(
        static_cast<std::uint16_t>(height == kHole ? shared::kHoleTexel : height));
  }
}

/// A run of cells of a part from a node on.
std::uint32_t make_run(const Nodes& nodes, glm::uvec2 corner, glm::uvec2 first,
                       std::uint32_t cells) {
  float steepest = 0.0F;
  for (std::uint32_t v = 0; v < 2 * (cells + 1); ++v) {
    const std::size_t k = nodes.index(first + glm::uvec2(v / 2, v % 2));
    if (nodes.is_border(k)) steepest = std::max(steepest, nodes.steepness(k));
  }
  const auto set_back = static_cast<std::uint32_t>(
      std::lround(shared::kBorderSetBack * steepest / shared::kSetBackStep));
  const glm::uvec2 place = first - corner;
  return place.x | (place.y << shared::kPlaceBits) | (cells << (2 * shared::kPlaceBits)) |
         (set_back << shared::kSetBackShift);
}

/// Appends the runs of a part's cells in row j, which end before column `end`.
void add_runs(const Nodes& nodes, glm::uvec2 corner, std::uint32_t j, std::uint32_t end,
              std::vector<std::uint32_t>& runs) {
  std::uint32_t i = corner.x;
  while (i < end) {
    const std::uint32_t first = i;
    while (i < end && i - first < shared::kRunCells && nodes.is_cell({i, j})) ++i;
    if (i > first) {
      runs.push_back(make_run(nodes, corner, {first, j}, i - first));
    } else {
      ++i;
    }
  }
}

/// A part without its rims; its sphere is about its nodes, one cell more than its own each way.
CellPart make_part(const Patch& patch, const Nodes& nodes, glm::uvec2 corner, double height_step) {
  CellPart part;
  part.corner = corner;
  const glm::uvec2 end = glm::min(corner + shared::kPartCells, {patch.width, patch.height});
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = corner.y; j < end.y; ++j) add_runs(nodes, corner, j, end.x, part.runs);
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
                    shared::kPartCells % shared::kRunCells == 0 &&
                    shared::kRunCells <= shared::kRunCellsMask,
                "a run's place and length fit their bits, and parts are whole runs wide");
  PatchCells cells;
  for (std::uint32_t j = 0; j < patch.height; ++j) add_row(patch, j, cells);
  cells.rows.push_back({});

  const Nodes nodes(patch, samples);
  const glm::uvec2 counts =
      (glm::uvec2(patch.width, patch.height) + (shared::kPartCells - 1)) / shared::kPartCells;
  for (std::uint32_t y = 0; y < counts.y; ++y) {
    for (std::uint32_t x = 0; x < counts.x; ++x) {
      cells.parts.push_back(
          make_part(patch, nodes, glm::uvec2(x, y) * shared::kPartCells, samples.height_step));
    }
  }
  for (const SampleRecord& record : samples.records) {
    const bool border = (record.place & shared::kBorderBit) != 0;
    assert((!border || record.gap == 0) && "margins of border splats are in their reaches");
    if (!border && nodes.off_edges(record) <= shared::kCrease) continue;
    const glm::uvec2 node = Nodes::place_of(record);
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

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
#include <utility>

#include "renderer/padded_heights.h"
#include "renderer/splat_reach.h"
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
  [[nodiscard]] bool has_four(glm::uvec2 node) const {
    const std::size_t k = index(node);
    const std::size_t above = k + heights_.stride();
    return heights_.valid(k) && heights_.valid(k + 1) && heights_.valid(above) &&
           heights_.valid(above + 1);
  }

  /// The same if they lie on one sheet.
  [[nodiscard]] bool is_cell(glm::uvec2 node) const {
    const std::size_t k = index(node);
    const std::size_t above = k + heights_.stride();
    return has_four(node) && on_one_sheet(k, k + 1) && on_one_sheet(above, above + 1) &&
           on_one_sheet(k, above) && on_one_sheet(k + 1, above + 1);
  }

  [[nodiscard]] bool is_border(std::size_t k) const {
    return (records_[k]->place & shared::kBorderBit) != 0;
  }

  /// One over the cosine of a splat's tilt.
  [[nodiscard]] float steepness(std::size_t k) const {
    const glm::vec2 slope = slope_of(*records_[k]);
    return std::sqrt(1.0F + glm::dot(slope, slope));
  }

  /// Whether one of the cells at a node has four samples but jumps to another sheet; of those that
  /// `counts` accepts.
  template <class Counts>
  [[nodiscard]] bool beside_jump(glm::uvec2 node, const Counts& counts) const {
    for (const glm::uvec2 back : {glm::uvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      if (node.x < back.x || node.y < back.y) continue;
      const glm::uvec2 corner = node - back;
      if (has_four(corner) && !is_cell(corner) && counts(corner)) return true;
    }
    return false;
  }

  /// The reaches of a splat with the margins that close its gaps, packed.
  [[nodiscard]] std::uint32_t closed_reach(const SampleRecord& record) const {
    const float cosine = 1.0F / steepness(index(place_of(record)));
    std::uint32_t packed = 0;
    for (std::uint32_t side = 0; side < 4; ++side) {
      const float gap = shared::kGapStep * static_cast<float>(byte_of(record.gap, side));
      const auto margin =
          static_cast<std::uint32_t>(std::ceil(fixed_margin(gap, cosine) / shared::kReachStep));
      packed |= std::min(byte_of(record.reach, side) + margin, 255U) << (8 * side);
    }
    return packed;
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
      const float reach = shared::kReachStep * static_cast<float>(byte_of(
                                                   record.reach, static_cast<std::uint32_t>(side)));
      const float run = forward ? slope[side / 2] : -slope[side / 2];
      most = std::max(most, reach * std::abs(run - rise));
    }
    return most / steepness(k);
  }

 private:
  [[nodiscard]] static std::uint32_t byte_of(std::uint32_t packed, std::uint32_t side) {
    return (packed >> (8 * side)) & 0xFFU;
  }

  /// Whether the rise from a node to one beside it is one that a splat may have.
  [[nodiscard]] bool on_one_sheet(std::size_t k, std::size_t beside) const {
    const auto rise = static_cast<float>(heights_[beside] - heights_[k]);
    return samples_.height_step * std::abs(rise) <= shared::kSteepest;
  }

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

/// Appends the runs, of at most `most` cells, of a part's cells in row j that `is_drawn` accepts,
/// which end before column `end`.
template <class IsDrawn>
void add_runs(const Nodes& nodes, glm::uvec2 corner, std::uint32_t j, std::uint32_t end,
              std::uint32_t most, const IsDrawn& is_drawn, std::vector<std::uint32_t>& runs) {
  std::uint32_t i = corner.x;
  while (i < end) {
    const std::uint32_t first = i;
    while (i < end && i - first < most && is_drawn(glm::uvec2(i, j))) ++i;
    if (i > first) {
      runs.push_back(make_run(nodes, corner, {first, j}, i - first));
    } else {
      ++i;
    }
  }
}

/// Parts of a patch each way.
glm::uvec2 part_counts(const Patch& patch) {
  return (glm::uvec2(patch.width, patch.height) + (shared::kPartCells - 1)) / shared::kPartCells;
}

/// A part without its rims; its sphere is about its nodes, one cell more than its own each way.
/// `whole`: as of a level, empty for a patch itself.
CellPart make_part(const Patch& patch, const std::vector<std::uint8_t>& whole, const Nodes& nodes,
                   glm::uvec2 corner, double height_step) {
  CellPart part;
  part.corner = corner;
  const glm::uvec2 end = glm::min(corner + shared::kPartCells, {patch.width, patch.height});
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  const auto is_whole = [&](glm::uvec2 node) {
    return whole.empty() || whole[std::size_t{node.y} * patch.width + node.x] != 0;
  };
  for (std::uint32_t j = corner.y; j < end.y; ++j) {
    add_runs(
        nodes, corner, j, end.x, shared::kRunCells,
        [&](glm::uvec2 node) { return nodes.is_cell(node) && is_whole(node); }, part.runs);
    add_runs(
        nodes, corner, j, end.x, shared::kEdgeRunCells,
        [&](glm::uvec2 node) { return nodes.has_four(node) && !is_whole(node); }, part.edge_runs);
  }
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

/// The cells of a patch or a level without its rims.
PatchCells make_cells_alone(const Patch& patch, const std::vector<std::uint8_t>& whole,
                            const Nodes& nodes, float height_step) {
  assert(patch.width <= kMaxPatchSide && patch.height <= kMaxPatchSide && "as its type says");
  static_assert(shared::kPartCells + 1 <= 1U << shared::kPlaceBits &&
                    shared::kPartCells % shared::kRunCells == 0 &&
                    shared::kRunCells <= shared::kRunCellsMask,
                "a run's place and length fit their bits, and parts are whole runs wide");
  PatchCells cells;
  for (std::uint32_t j = 0; j < patch.height; ++j) add_row(patch, j, cells);
  cells.rows.push_back({});

  const glm::uvec2 counts = part_counts(patch);
  for (std::uint32_t y = 0; y < counts.y; ++y) {
    for (std::uint32_t x = 0; x < counts.x; ++x) {
      cells.parts.push_back(
          make_part(patch, whole, nodes, glm::uvec2(x, y) * shared::kPartCells, height_step));
    }
  }
  return cells;
}

/// Adds the splats of the samples that `has_rim` accepts to the parts that they lie in.
template <class HasRim>
void add_rims(const Patch& patch, const Nodes& nodes, const PatchSamples& samples,
              PatchCells& cells, const HasRim& has_rim) {
  const std::uint32_t columns = part_counts(patch).x;
  for (const SampleRecord& record : samples.records) {
    if (!has_rim(record)) continue;
    const glm::uvec2 node = Nodes::place_of(record);
    const glm::uvec2 part = node / shared::kPartCells;
    const glm::uvec2 place = node - part * shared::kPartCells;
    cells.parts[std::size_t{part.y} * columns + part.x].rims.push_back(
        {place.x | (place.y << shared::kPlaceBits) | (record.shape & 0xFFFF0000U),
         nodes.closed_reach(record)});
  }
  for (CellPart& part : cells.parts) {
    if (!part.rims.empty()) part.radius += samples.widest_disc;
  }
}

/// Leaves out the parts that draw nothing.
PatchCells without_empty_parts(PatchCells cells) {
  std::erase_if(cells.parts, [](const CellPart& part) {
    return part.runs.empty() && part.edge_runs.empty() && part.rims.empty();
  });
  return cells;
}

}  // namespace

PatchCells make_cells(const Patch& patch, const PatchSamples& samples) {
  const Nodes nodes(patch, samples);
  PatchCells cells = make_cells_alone(patch, {}, nodes, samples.height_step);
  add_rims(patch, nodes, samples, cells, [&](const SampleRecord& record) {
    const bool border = (record.place & shared::kBorderBit) != 0;
    assert((!border || record.gap == 0) && "margins of border splats are in their reaches");
    return border || nodes.beside_jump(Nodes::place_of(record), [](glm::uvec2) { return true; }) ||
           nodes.off_edges(record) > shared::kCrease;
  });
  return without_empty_parts(std::move(cells));
}

// Creases have no splats in a level: what they stick out is a coarse cell long there (the Dragon at
// level 1, 1280x1024, lit: 38.5 dB without, 36.3 with; its silhouettes then lack 426 and 185 pixels
// of four views).
PatchCells make_cells(const PatchLevel& level, const PatchSamples& samples) {
  const Nodes nodes(level.grid, samples);
  PatchCells cells = make_cells_alone(level.grid, level.whole, nodes, samples.height_step);
  const auto is_whole = [&level](glm::uvec2 node) {
    return level.whole[std::size_t{node.y} * level.grid.width + node.x] != 0;
  };
  add_rims(level.grid, nodes, samples, cells, [&](const SampleRecord& record) {
    return nodes.beside_jump(Nodes::place_of(record), is_whole);
  });
  return without_empty_parts(std::move(cells));
}

}  // namespace relief

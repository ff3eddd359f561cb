#include "renderer/geometry/cells/cells.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "common/seams/cell_triangles.h"
#include "renderer/geometry/cells/border_cells.h"
#include "renderer/geometry/cells/cell_nodes.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

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

/// How a cell is drawn, by the node at its lower left.
enum class CellKind : std::uint8_t { None, Run, EdgeRun, Strip };

/// What the cells of a patch or a level are made of.
struct CellSource {
  const Patch& patch;
  std::vector<CellKind> kinds;  ///< by node
  const CellNodes* nodes;       ///< null: nothing is set back
  double height_step;           ///< cells per height index

  [[nodiscard]] CellKind kind(glm::uvec2 node) const {
    return kinds[std::size_t{node.y} * patch.width + node.x];
  }
};

/// The kinds of a patch's cells, as `kind_of` tells them.
template <class KindOf>
std::vector<CellKind> kinds_of(const Patch& patch, const KindOf& kind_of) {
  std::vector<CellKind> kinds;
  kinds.reserve(patch.heights.size());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) kinds.push_back(kind_of(glm::uvec2(i, j)));
  }
  return kinds;
}

/// A run of cells of a part from a node on.
std::uint32_t make_run(const CellNodes* nodes, glm::uvec2 corner, glm::uvec2 first,
                       std::uint32_t cells) {
  float steepest = 0.0F;
  for (std::uint32_t v = 0; nodes != nullptr && v < 2 * (cells + 1); ++v) {
    const std::size_t k = nodes->index(first + glm::uvec2(v / 2, v % 2));
    if (nodes->is_border(k)) steepest = std::max(steepest, nodes->steepness(k));
  }
  const glm::uvec2 position = first - corner;
  return position.x | (position.y << shared::kNodeInPartBits) |
         (cells << (2 * shared::kNodeInPartBits)) |
         (set_back_steps(steepest) << shared::kSetBackShift);
}

/// Appends the runs, of at most `most` cells, of a part's cells of a kind in row j, which end
/// before column `end`.
void add_runs(const CellSource& source, CellKind kind, glm::uvec2 corner, std::uint32_t j,
              std::uint32_t end, std::uint32_t most, std::vector<std::uint32_t>& runs) {
  std::uint32_t i = corner.x;
  while (i < end) {
    const std::uint32_t first = i;
    while (i < end && i - first < most && source.kind({i, j}) == kind) ++i;
    if (i > first) {
      runs.push_back(make_run(source.nodes, corner, {first, j}, i - first));
    } else {
      ++i;
    }
  }
}

/// A node of a part in a strip.
std::uint16_t in_strip(glm::uvec2 node, glm::uvec2 corner) {
  const glm::uvec2 position = node - corner;
  return static_cast<std::uint16_t>(position.x | (position.y << shared::kStripRowShift));
}

/// Appends a part's cells of the kind Strip in row j, which end before column `end`. The first and
/// the last node of what hangs together are there twice, so that empty triangles join it to the
/// rest.
void add_strip(const CellSource& source, glm::uvec2 corner, std::uint32_t j, std::uint32_t end,
               std::vector<std::uint16_t>& strip) {
  const auto is_drawn = [&](std::uint32_t i) {
    return i < end && source.kind({i, j}) == CellKind::Strip;
  };
  for (std::uint32_t i = corner.x; i < end; ++i) {
    if (!is_drawn(i)) continue;
    if (!strip.empty()) strip.insert(strip.end(), {strip.back(), in_strip({i, j + 1}, corner)});
    strip.insert(strip.end(), {in_strip({i, j + 1}, corner), in_strip({i, j}, corner)});
    for (; is_drawn(i); ++i) {
      strip.insert(strip.end(), {in_strip({i + 1, j + 1}, corner), in_strip({i + 1, j}, corner)});
    }
  }
}

/// Adds the normals of a cell's two triangles, halved along the diagonal from (0, 0).
void add_normals(const Patch& patch, glm::uvec2 node, double height_step, NormalBounds& normals) {
  const auto height = [&](std::uint32_t i, std::uint32_t j) {
    return static_cast<float>(patch.at(node.x + i, node.y + j) * height_step);
  };
  const float h00 = height(0, 0);
  const float h10 = height(1, 0);
  const float h01 = height(0, 1);
  const float h11 = height(1, 1);
  normals.add({h00 - h10, h10 - h11, 1.0F});
  normals.add({h01 - h11, h00 - h01, 1.0F});
}

/// A part without its rims; its sphere is about its nodes, one cell more than its own each way.
CellPart make_part(const CellSource& source, glm::uvec2 corner) {
  const Patch& patch = source.patch;
  CellPart part;
  part.corner = corner;
  const glm::uvec2 end = glm::min(corner + shared::kPartCells, {patch.width, patch.height});
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = corner.y; j < end.y; ++j) {
    add_runs(source, CellKind::Run, corner, j, end.x, shared::kRunCells, part.runs);
    add_runs(source, CellKind::EdgeRun, corner, j, end.x, shared::kEdgeRunCells, part.edge_runs);
    add_strip(source, corner, j, end.x, part.strip);
    for (std::uint32_t i = corner.x; i < end.x; ++i) {
      if (source.kind({i, j}) != CellKind::None)
        add_normals(patch, {i, j}, source.height_step, part.normals);
    }
  }
  for (std::uint32_t j = corner.y; j < std::min(end.y + 1, patch.height); ++j) {
    for (std::uint32_t i = corner.x; i < std::min(end.x + 1, patch.width); ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 p(i, j, patch.at(i, j) * source.height_step);
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
PatchCells make_cells_alone(const CellSource& source) {
  const Patch& patch = source.patch;
  assert(patch.width <= kMaxPatchSide && patch.height <= kMaxPatchSide && "as its type says");
  static_assert(shared::kPartCells + 1 <= 1U << shared::kNodeInPartBits &&
                    shared::kPartCells % shared::kRunCells == 0 &&
                    shared::kRunCells <= shared::kRunCellsMask,
                "a run's position and length fit their bits, and parts are whole runs wide");
  static_assert(
      shared::kPartCells < 1U << shared::kStripRowShift && 2 * shared::kStripRowShift <= 16,
      "a node of a strip fits its bits");
  PatchCells cells;
  for (std::uint32_t j = 0; j < patch.height; ++j) add_row(patch, j, cells);
  cells.rows.push_back({});

  const glm::uvec2 counts = part_counts(patch);
  for (std::uint32_t y = 0; y < counts.y; ++y) {
    for (std::uint32_t x = 0; x < counts.x; ++x)
      cells.parts.push_back(make_part(source, glm::uvec2(x, y) * shared::kPartCells));
  }
  return cells;
}

/// Adds the splats of the samples of which `reach_of` gives how far they reach to the parts that
/// they lie in.
template <class ReachOf>
void add_rims(const Patch& patch, const PatchSamples& samples, PatchCells& cells,
              const ReachOf& reach_of) {
  for (const SampleRecord& record : samples.records) {
    const std::optional<std::uint32_t> reach = reach_of(record);
    if (!reach) continue;
    const glm::uvec2 node = CellNodes::node_of(record);
    CellPart& part = cells.parts[part_at(patch, node)];
    const glm::uvec2 position = node - part.corner;
    part.rims.push_back(
        {position.x | (position.y << shared::kNodeInPartBits) | (record.shape & 0xFFFF0000U),
         *reach});
  }
  for (CellPart& part : cells.parts) {
    if (part.rims.empty()) continue;
    part.radius += samples.widest_disc;
    part.normals = {};
  }
}

/// Leaves out the parts that draw nothing.
PatchCells without_empty_parts(PatchCells cells) {
  std::erase_if(cells.parts, [](const CellPart& part) {
    return part.runs.empty() && part.edge_runs.empty() && part.strip.empty() &&
           part.borders.empty() && part.rims.empty();
  });
  return cells;
}

}  // namespace

PatchCells make_cells(const Patch& patch, const PatchSamples& samples) {
  const CellNodes nodes(patch, samples);
  const auto kind_of = [&](glm::uvec2 node) {
    return nodes.is_cell(node) ? CellKind::Run : CellKind::None;
  };
  PatchCells cells =
      make_cells_alone({patch, kinds_of(patch, kind_of), &nodes, samples.height_step});
  const PatchBorder border(patch);
  add_border_cells(patch, border, nodes, cells);
  add_rims(patch, samples, cells,
           [&](const SampleRecord& record) { return rim_reach(nodes, border, record); });
  return without_empty_parts(std::move(cells));
}

PatchCells make_joined_cells(const Patch& patch) {
  const CellTriangles triangles = cell_triangles(patch);
  const auto kind_of = [&](glm::uvec2 node) {
    return triangles.at(node.x, node.y) == kWholeCell ? CellKind::Strip : CellKind::None;
  };
  return without_empty_parts(make_cells_alone(
      {patch, kinds_of(patch, kind_of), nullptr, patch.height_step / patch.spacing}));
}

// Creases have no splats in a level: what they stick out is a coarse cell long there (the Dragon at
// level 1, 1280x1024, lit: 38.5 dB without, 36.3 with; its silhouettes then lack 426 and 185 pixels
// of four views).
PatchCells make_cells(const PatchLevel& level, const PatchSamples& samples) {
  const CellNodes nodes(level.grid, samples);
  const auto is_whole = [&level](glm::uvec2 node) {
    return level.whole[std::size_t{node.y} * level.grid.width + node.x] != 0;
  };
  const auto kind_of = [&](glm::uvec2 node) {
    if (is_whole(node)) return nodes.is_cell(node) ? CellKind::Run : CellKind::None;
    return nodes.has_four(node) ? CellKind::EdgeRun : CellKind::None;
  };
  PatchCells cells =
      make_cells_alone({level.grid, kinds_of(level.grid, kind_of), &nodes, samples.height_step});
  add_rims(level.grid, samples, cells,
           [&](const SampleRecord& record) -> std::optional<std::uint32_t> {
             if (!nodes.beside_jump(CellNodes::node_of(record), is_whole)) return {};
             return nodes.closed_reach(record, true);
           });
  return without_empty_parts(std::move(cells));
}

}  // namespace relief

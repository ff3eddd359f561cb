// The order in which codec 2 of the patch file visits heights, coarse levels first, and what it
// expects of each: the same for writing, reading and training.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/compact/height_predictor.h"
#include "common/compact/level_grid.h"
#include "common/compact/residual_classes.h"

namespace relief {

/// What is expected of one height.
struct Expectation {
  std::int32_t height = 0;
  unsigned residual_class = 0;
};

/// The class of the coarsest level's residuals, which follow from next to nothing.
inline constexpr unsigned kCoarsestClass = 46;

/// Errors of rows were learned on all levels, of which the finest has three quarters of the nodes:
/// what they are on each level, in quarters; the last for all coarser ones too.
inline constexpr std::array<std::uint32_t, 7> kErrorScales{3, 5, 8, 14, 26, 42, 64};

/// The rows about one node: row(j)[i] is what an array of the level holds there.
template <class Value>
struct RowsAbout {
  const Value* node;
  std::ptrdiff_t stride;
  [[nodiscard]] const Value& at(NodeOffset offset) const {
    return node[offset.j * stride + offset.i];
  }
};

/// Calls `use(k)` for each k below `Count`, each in its own code.
template <std::size_t Count, class Use>
inline void unrolled(const Use& use) {
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (use(std::integral_constant<std::size_t, K>()), ...);
  }
  (std::make_index_sequence<Count>());
}

/// Sets `inside[i]` to 1 for the nodes of a row all of whose neighbours and near residuals are
/// samples: most of them, and of these the same is expected in fewer steps.
template <const HeightPass& Pass>
void find_inside(const LevelGrid& grid, std::uint32_t j, std::vector<std::uint8_t>& inside) {
  const RowsAbout<std::uint8_t> first{&grid.samples[grid.node(0, j)],
                                      static_cast<std::ptrdiff_t>(grid.stride)};
  // Through pointers of their own, as bytes may be parts of anything and nothing would stay in
  // registers (this took a third of the time).
  std::uint8_t* const to = inside.data();
  const std::size_t width = grid.width;
  for (std::size_t i = 0; i < width; ++i) {
    std::uint8_t all = first.node[i];
    unrolled<kMostNeighbours>([&](auto k) { all &= (&first.at(Pass.neighbours[k]))[i]; });
    unrolled<kNearResiduals>([&](auto k) { all &= (&first.at(Pass.residuals[k].at))[i]; });
    to[i] = all;
  }
}

/// Visits the samples of a level's pass (columns i0, i0 + di ... of rows j0, j0 + 2 ...):
/// `code(height, expectation)` sets or reads the height and returns the residual.
template <const HeightPass& Pass, class Code>
void visit_pass(const PredictorTable& table, std::uint32_t i0, std::uint32_t di, std::uint32_t j0,
                LevelGrid& grid, const Code& code) {
  const auto stride = static_cast<std::ptrdiff_t>(grid.stride);
  const std::uint32_t error_scale = kErrorScales[std::min<std::size_t>(grid.level, 6)];
  const PredictorRow all = table.row((1U << kMostNeighbours) - 1U);
  const std::uint32_t error_of_all = Pass.error_weight * all.error * error_scale / 64;
  std::vector<std::uint8_t> inside(grid.width);
  const std::uint32_t width = grid.width;
  std::int32_t last = grid.last;
  for (std::uint32_t j = j0; j < grid.height; j += 2) {
    find_inside<Pass>(grid, j, inside);
    const std::uint8_t* const is_inside = inside.data();
    const std::uint8_t* const sample_row = &grid.samples[grid.node(0, j)];
    std::int32_t* const height_row = &grid.heights[grid.node(0, j)];
    std::uint8_t* const magnitude_row = &grid.magnitudes[grid.node(0, j)];
    for (std::uint32_t i = i0; i < width; i += di) {
      if (sample_row[i] == 0) continue;
      const RowsAbout<std::uint8_t> samples{sample_row + i, stride};
      const RowsAbout<std::int32_t> heights{height_row + i, stride};
      const RowsAbout<std::uint8_t> magnitudes{magnitude_row + i, stride};
      std::uint32_t expected = 0;
      unrolled<kNearResiduals>([&](auto k) {
        constexpr NearResidual kNear = Pass.residuals[k];
        if constexpr (kNear.weight > 0)
          expected += kNear.weight * std::uint32_t{magnitudes.at(kNear.at)};
      });
      std::int32_t sum = 1 << (kWeightBits - 1);
      if (is_inside[i] != 0) {
        unrolled<kMostNeighbours>(
            [&](auto k) { sum += all.weights[k] * heights.at(Pass.neighbours[k]); });
        sum >>= kWeightBits;
        expected += error_of_all;
      } else {
        std::uint32_t known = 0;
        unrolled<kMostNeighbours>(
            [&](auto k) { known |= std::uint32_t{samples.at(Pass.neighbours[k])} << k; });
        const PredictorRow& row = table.row(known);
        unrolled<kMostNeighbours>(
            [&](auto k) { sum += row.weights[k] * heights.at(Pass.neighbours[k]); });
        sum = row.known != 0 ? sum >> kWeightBits : last;
        std::uint32_t error_weight = Pass.error_weight;
        unrolled<kNearResiduals>([&](auto k) {
          constexpr NearResidual kNear = Pass.residuals[k];
          error_weight += samples.at(kNear.at) != 0 ? 0 : kNear.weight;
        });
        expected += error_weight * row.error * error_scale / 64;
      }
      const std::int32_t r = code(height_row[i], Expectation{sum, class_of(expected)});
      magnitude_row[i] = static_cast<std::uint8_t>(std::min(std::abs(r), 255));
      last = height_row[i];
    }
  }
  grid.last = last;
}

/// Visits the samples of a level that are on no coarser one.
template <class Code>
void visit_level(const PredictorTables& tables, LevelGrid& grid, const Code& code) {
  visit_pass<kRowPass>(tables.rows, 1, 2, 0, grid, code);
  visit_pass<kColumnPass>(tables.columns, 0, 1, 1, grid, code);
}

/// Visits the at most four samples of the coarsest level; each is expected as the one before.
template <class Code>
void visit_coarsest(LevelGrid& grid, const Code& code) {
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = grid.node(i, j);
      if (grid.samples[node] == 0) continue;
      code(grid.heights[node], Expectation{grid.last, kCoarsestClass});
      grid.last = grid.heights[node];
    }
  }
}

}  // namespace relief

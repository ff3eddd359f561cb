// The order in which codec 2 of the patch file visits heights, coarse levels first, and the height
// it expects for each. Writing, reading and training share this code.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/patch_file/compact/height_predictor.h"
#include "common/patch_file/compact/height_rows.h"
#include "common/patch_file/compact/level_grid.h"
#include "common/patch_file/compact/residual_classes.h"

namespace relief {

/// The prediction of one height, less kHeightBase like all heights of a LevelGrid.
struct Expectation {
  std::int32_t height = 0;
  unsigned residual_class = 0;
};

/// Magnitudes are clamped to this when they predict others.
inline constexpr std::uint32_t kMaxMagnitude = 255;

/// The class of the coarsest level's residuals, which have almost no prediction.
inline constexpr unsigned kCoarsestClass = 46;

/// Factors of the rows' errors for each level, in quarters; the last also for all coarser levels.
/// The errors were learned on all levels together; the finest has three quarters of the nodes.
inline constexpr std::array<std::uint32_t, 7> kErrorScales{3, 5, 8, 14, 26, 42, 64};

/// Share of a pass's row errors in the expectation, in 1/256, by the bits of the near residuals
/// whose nodes are samples. It stands in for the missing ones.
template <const HeightPass& Pass>
inline constexpr auto kErrorWeights = [] {
  std::array<std::uint32_t, 1U << kNearResiduals> weights{};
  for (std::size_t bits = 0; bits < weights.size(); ++bits) {
    weights[bits] = Pass.error_weight;
    for (std::size_t k = 0; k < kNearResiduals; ++k)
      weights[bits] += (bits >> k & 1U) != 0 ? 0U : Pass.residuals[k].weight;
  }
  return weights;
}();

/// Visits the samples of a level's pass: `code(height, expectation)` sets or reads the height and
/// returns the magnitude of the residual, at most kMaxMagnitude. `code` is passed and returned by
/// value, so that a decoder's state stays in registers.
template <const HeightPass& Pass, class Code>
[[nodiscard]] Code visit_pass(const PredictorTable& table, LevelGrid& grid, Code code) {
  using Row = HeightRow<Pass>;
  constexpr std::uint32_t kOfBefore = weight_at(Pass, -Pass.step, 0);
  constexpr std::uint32_t kOfSecond = weight_at(Pass, -2 * Pass.step, 0);
  constexpr std::uint32_t kNeighbourBits = (1U << kMaxNeighbours) - 1U;
  const ResidualClasses& classes = residual_classes();
  const std::uint32_t error_scale = kErrorScales[std::min<std::size_t>(grid.level, 6)];
  const PredictorRow& of_all = table.row(kNeighbourBits);
  const std::int32_t all_of_last = of_all.weights[Row::kBefore];
  const std::uint32_t error_of_all = Pass.error_weight * of_all.error * error_scale / 64;
  Row row(grid, of_all);
  std::int32_t last = grid.last;
  for (std::uint32_t j = Pass.first_row; j < grid.height; j += 2) {
    row.go_to(grid, j);
    const std::size_t first = grid.node(Pass.first, j);
    const std::uint8_t* const samples = &grid.samples[first];
    std::int16_t* const heights = &grid.heights[first];
    std::uint8_t* const magnitudes = &grid.magnitudes[first];
    const std::size_t nodes = (grid.width - Pass.first + Pass.step - 1) / Pass.step;
    // Of the two nodes visited before this one; 0 for a hole.
    std::uint32_t before = 0;
    std::uint32_t second = 0;
    for (std::size_t n = 0; n < nodes; ++n) {
      const std::size_t i = n * Pass.step;
      if (samples[i] == 0) {
        second = before;
        before = 0;
        continue;
      }
      std::int32_t height = 1 << (kWeightBits - 1);
      std::uint32_t magnitude = row.near(n);
      const std::uint32_t known = row.known(n);
      if (known == Row::kAll) {
        height += row.sum(n) + all_of_last * last;
        magnitude += error_of_all;
      } else {
        const PredictorRow& weights = table.row(known & kNeighbourBits);
        // The previous height is the last sample's, also without neighbours.
        const std::int32_t of_last =
            weights.known != 0 ? weights.weights[Row::kBefore] : 1 << kWeightBits;
        height += row.sum(n, weights) + of_last * last;
        magnitude +=
            kErrorWeights<Pass>[known >> kMaxNeighbours] * weights.error * error_scale / 64;
      }
      magnitude += kOfBefore * before + kOfSecond * second;
      second = before;
      before = code(heights[i], Expectation{height >> kWeightBits, classes.number_of(magnitude)});
      last = heights[i];
      magnitudes[i] = static_cast<std::uint8_t>(before);
    }
  }
  grid.last = last;
  return code;
}

/// Visits the samples of a level that no coarser level has.
template <class Code>
[[nodiscard]] Code visit_level(const PredictorTables& tables, LevelGrid& grid, Code code) {
  code = visit_pass<kRowPass>(tables.rows, grid, std::move(code));
  return visit_pass<kColumnPass>(tables.columns, grid, std::move(code));
}

/// Visits the at most four samples of the coarsest level; each is predicted by the one before.
template <class Code>
[[nodiscard]] Code visit_coarsest(LevelGrid& grid, Code code) {
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = grid.node(i, j);
      if (grid.samples[node] == 0) continue;
      code(grid.heights[node], Expectation{grid.last, kCoarsestClass});
      grid.last = grid.heights[node];
    }
  }
  return code;
}

}  // namespace relief

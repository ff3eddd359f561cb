// Predicts a height from the coded heights around it, in codec 2 of the patch file
// (docs/patch-file.md, "Codec 2").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace relief {

/// A node relative to the predicted one; (0, 0) stands for none.
struct NodeOffset {
  std::int8_t i = 0;
  std::int8_t j = 0;
};

/// An earlier residual of the same level, and its share (in 1/256) in the expected magnitude.
struct NearResidual {
  NodeOffset at;
  std::uint8_t weight = 0;
};

inline constexpr std::size_t kMaxNeighbours = 10;
inline constexpr std::size_t kNearResiduals = 5;
/// Weights of predictions are in 1/1024.
inline constexpr unsigned kWeightBits = 10;

/// The prediction of a height from the neighbours that exist.
struct PredictorRow {
  std::uint16_t known = 0;  ///< bit k: neighbour k of the stencil is used
  std::uint16_t error = 0;  ///< the mean magnitude of residuals, in 1/16
  std::array<std::int16_t, kMaxNeighbours> weights{};  ///< their sum is 1024
};

/// A level is coded in two passes with different neighbours.
struct HeightPass {
  std::uint32_t first;      ///< its first column
  int step;                 ///< from each of its columns to the next
  std::uint32_t first_row;  ///< every second one from there
  std::array<NodeOffset, kMaxNeighbours> neighbours;
  std::array<NearResidual, kNearResiduals> residuals;
  std::uint32_t error_weight;  ///< share of PredictorRow::error in the expected magnitude, in 1/256
};

/// Nodes with odd i and even j.
inline constexpr HeightPass kRowPass{
    1,
    2,
    0,
    {{{-1, 0}, {1, 0}, {-3, 0}, {3, 0}, {0, -2}, {-1, -2}, {1, -2}, {-1, 2}, {1, 2}, {-2, 0}}},
    {{{{-2, 0}, 68}, {{0, -2}, 46}, {{-2, -2}, 14}, {{2, -2}, 27}, {{0, 0}, 0}}},
    64};
/// Nodes with odd j.
inline constexpr HeightPass kColumnPass{
    0,
    1,
    1,
    {{{0, -1}, {0, 1}, {0, -3}, {0, 3}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}, {-1, 0}, {0, 0}}},
    {{{{-1, 0}, 77}, {{-2, 0}, 18}, {{0, -2}, 33}, {{1, -2}, 18}, {{0, 1}, 14}}},
    48};

/// Returns the share of the residual at a node in a pass's expected magnitude.
[[nodiscard]] constexpr std::uint32_t weight_at(const HeightPass& pass, int i, int j) {
  for (const NearResidual& near : pass.residuals) {
    if (near.at.i == i && near.at.j == j) return near.weight;
  }
  return 0;
}

/// The row to use for each set of existing neighbours: among the rows whose neighbours all exist,
/// the one with the most neighbours, and among these the one with the smallest error.
class PredictorTable {
 public:
  explicit PredictorTable(std::span<const PredictorRow> rows);
  [[nodiscard]] const PredictorRow& row(std::uint32_t known) const { return rows_[row_of_[known]]; }

 private:
  std::span<const PredictorRow> rows_;
  std::array<std::uint16_t, 1U << kMaxNeighbours> row_of_{};
};

struct PredictorTables {
  PredictorTable rows;     ///< of kRowPass
  PredictorTable columns;  ///< of kColumnPass
};

/// Returns the tables of codec 2; made once.
[[nodiscard]] const PredictorTables& predictor_tables();

}  // namespace relief

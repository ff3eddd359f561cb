// Finds the tables of codec 2 (common/compact/*.inc) from patch files: how heights follow from
// their neighbours, and how probable samples are.
// usage: train_height_predictor OUT_FOLDER FILE.relief...
// Every second file is learned from; the bits of all are told.
#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/compact/height_levels.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/patch_file.h"

using namespace relief;

namespace {

constexpr int kRounds = 4;
/// Patterns of fewer heights are left to those that know less.
constexpr double kLeastHeights = 300;

/// Weighted least squares of one pattern, relative to its first neighbour.
struct Pattern {
  Eigen::MatrixXd left;
  Eigen::VectorXd right;
  double heights = 0.0;
  double magnitude = 0.0;
};

bool is_none(NodeOffset at) {
  return at.i == 0 && at.j == 0;
}

using Patterns = std::map<std::uint32_t, Pattern>;

struct Scan {
  std::vector<Patch> patches;
  double samples = 0.0;
};

/// Adds one height to its pattern.
void learn(const HeightPass& pass, const LevelGrid& grid, std::size_t node, Expectation e,
           double weight, Patterns& patterns) {
  const auto stride = static_cast<std::ptrdiff_t>(grid.stride);
  std::uint32_t known = 0;
  std::vector<double> values;
  for (std::size_t k = 0; k < kMostNeighbours; ++k) {
    const NodeOffset at = pass.neighbours[k];
    const auto n =
        static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + at.j * stride + at.i);
    if (is_none(at) || grid.samples[n] == 0) continue;
    known |= 1U << k;
    values.push_back(grid.heights[n]);
  }
  if (known == 0) return;
  Pattern& pattern = patterns[known];
  const auto size = static_cast<Eigen::Index>(values.size()) - 1;
  if (pattern.heights == 0.0) {
    pattern.left = Eigen::MatrixXd::Zero(size, size);
    pattern.right = Eigen::VectorXd::Zero(size);
  }
  Eigen::VectorXd x(size);
  for (Eigen::Index k = 0; k < size; ++k)
    x[k] = values[static_cast<std::size_t>(k) + 1] - values[0];
  const double r = grid.heights[node] - e.height;
  // The bits of a residual grow with its logarithm: each counts as the square of what is expected.
  const double expected = std::exp2((e.residual_class + 0.5) / 4.0 + 3.0 - kExpectationBits);
  const double w = weight / (0.2 + expected * expected + 0.1 * r * r);
  pattern.left += w * x * x.transpose();
  pattern.right += w * x * (grid.heights[node] - values[0]);
  pattern.heights += 1.0;
  pattern.magnitude += std::min(std::abs(r), 255.0);
}

PredictorRow solve(std::uint32_t known, const Pattern& pattern) {
  PredictorRow row;
  row.known = static_cast<std::uint16_t>(known);
  row.error = static_cast<std::uint16_t>(
      std::lround(std::max(16.0 * pattern.magnitude / pattern.heights, 4.0)));
  const Eigen::Index size = pattern.right.size();
  Eigen::VectorXd weights;
  if (size > 0) {
    const double ridge = 1e-5 * pattern.left.trace() / static_cast<double>(size);
    weights =
        (pattern.left + ridge * Eigen::MatrixXd::Identity(size, size)).ldlt().solve(pattern.right);
  }
  Eigen::Index next = -1;
  std::size_t first = 0;
  int sum = 0;
  for (std::size_t k = 0; k < kMostNeighbours; ++k) {
    if ((known >> k & 1U) == 0) continue;
    if (next < 0) {
      first = k;
    } else {
      row.weights[k] = static_cast<std::int16_t>(std::lround(1024.0 * weights[next]));
      sum += row.weights[k];
    }
    ++next;
  }
  row.weights[first] = static_cast<std::int16_t>(1024 - sum);
  return row;
}

std::vector<PredictorRow> solve_all(const HeightPass& pass, const Patterns& patterns) {
  std::vector<PredictorRow> rows;
  for (const auto& [known, pattern] : patterns) {
    if (pattern.heights >= kLeastHeights) rows.push_back(solve(known, pattern));
  }
  // What any neighbour alone says, where nothing better was learned: forty steps off.
  for (std::uint32_t k = 0; k < kMostNeighbours; ++k) {
    const std::uint32_t known = 1U << k;
    if (is_none(pass.neighbours[k])) continue;
    if (std::any_of(rows.begin(), rows.end(), [&](const auto& r) { return r.known == known; }))
      continue;
    PredictorRow row{static_cast<std::uint16_t>(known), 640, {}};
    row.weights[k] = 1024;
    rows.push_back(row);
  }
  rows.push_back({0, 16000, {}});
  return rows;
}

void train_heights(const std::vector<Scan>& scans, std::vector<PredictorRow>& rows,
                   std::vector<PredictorRow>& columns) {
  PredictorTables tables = predictor_tables();
  for (int round = 0; round < kRounds; ++round) {
    Patterns row_patterns;
    Patterns column_patterns;
    for (std::size_t s = 0; s < scans.size(); s += 2) {
      const double weight = 1.0 / std::sqrt(scans[s].samples);
      for (const Patch& patch : scans[s].patches) {
        const auto mask = sample_mask(patch);
        for (unsigned level = 0; level < coarsest_level(patch.width, patch.height); ++level) {
          LevelGrid grid(patch.width, patch.height, level);
          mark_samples(mask, patch.width, level, grid);
          for (std::uint32_t j = 0; j < grid.height; ++j) {
            for (std::uint32_t i = 0; i < grid.width; ++i) {
              if (grid.samples[grid.node(i, j)] != 0) {
                grid.heights[grid.node(i, j)] = static_cast<std::int16_t>(
                    patch.at(i << level, j << level) - LevelGrid::kHeightBase);
              }
            }
          }
          const auto see = [&](const HeightPass& pass, Patterns& patterns) {
            return [&](const std::int16_t& height, Expectation e) {
              const auto node = static_cast<std::size_t>(&height - grid.heights.data());
              learn(pass, grid, node, e, weight, patterns);
              const auto magnitude = static_cast<std::uint32_t>(std::abs(height - e.height));
              return std::min(magnitude, kMostMagnitude);
            };
          };
          static_cast<void>(visit_pass<kRowPass>(tables.rows, grid, see(kRowPass, row_patterns)));
          static_cast<void>(
              visit_pass<kColumnPass>(tables.columns, grid, see(kColumnPass, column_patterns)));
        }
      }
    }
    rows = solve_all(kRowPass, row_patterns);
    columns = solve_all(kColumnPass, column_patterns);
    tables = {PredictorTable(rows), PredictorTable(columns)};
  }
}

std::string as_source(const char* name, const std::vector<PredictorRow>& rows) {
  std::string text = fmt::format("constexpr PredictorRow {}[] = {{\n", name);
  for (const PredictorRow& row : rows) {
    text += fmt::format("    {{{}, {}, {{", row.known, row.error);
    for (std::size_t k = 0; k < kMostNeighbours; ++k)
      text += fmt::format("{}{}", k > 0 ? ", " : "", row.weights[k]);
    text += "}},\n";
  }
  return text + "};\n";
}

/// The chances of samples in the contexts of compact_mask.cpp.
std::string train_mask(const std::vector<Scan>& scans) {
  std::vector<std::array<double, 2>> counts(256, {0.4, 0.4});
  for (std::size_t s = 0; s < scans.size(); s += 2) {
    const double weight = 1e5 / scans[s].samples;
    for (const Patch& patch : scans[s].patches) {
      const auto at = [&](std::int64_t i, std::int64_t j) -> unsigned {
        return i >= 0 && j >= 0 && i < patch.width &&
                       patch.at(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)) !=
                           kHole
                   ? 1
                   : 0;
      };
      for (std::int64_t j = 0; j < patch.height; ++j) {
        for (std::int64_t i = 0; i < patch.width; ++i) {
          const unsigned context = at(i - 1, j) | at(i - 2, j) << 1U | at(i + 2, j - 1) << 2U |
                                   at(i + 1, j - 1) << 3U | at(i, j - 1) << 4U |
                                   at(i - 1, j - 1) << 5U | at(i - 2, j - 1) << 6U |
                                   at(i, j - 2) << 7U;
          counts[context][at(i, j)] += weight;
        }
      }
    }
  }
  std::string text = "constexpr std::uint16_t kSampleChances[256] = {";
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const long chance = std::lround(4096.0 * counts[c][1] / (counts[c][0] + counts[c][1]));
    text += fmt::format("{}{},", c % 16 == 0 ? "\n    " : " ", std::clamp(chance, 1L, 4095L));
  }
  return text + "\n};\n";
}

void tell_bits(const char* name, const Scan& scan) {
  std::size_t bytes = 0;
  for (const Patch& patch : scan.patches) bytes += encode_heights_compact(patch).size();
  fmt::print("{:60} {:8} samples {:.3f} bits\n", name, scan.samples,
             8.0 * static_cast<double>(bytes) / scan.samples);
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<Scan> scans;
  for (int a = 2; a < count; ++a) {
    Progress progress;
    auto file = PatchFile::open(arguments[a]);
    auto model = file ? file->read_all(progress) : Result<PatchModel>(file.error());
    if (!model) {
      fmt::print(stderr, "{}\n", model.error().message);
      return 1;
    }
    const auto samples = static_cast<double>(count_samples(*model));
    scans.push_back({std::move(model->patches), samples});
    tell_bits(arguments[a], scans.back());
  }
  std::vector<PredictorRow> rows;
  std::vector<PredictorRow> columns;
  train_heights(scans, rows, columns);
  fmt::print("{} and {} rows\n", rows.size(), columns.size());
  const std::string folder = arguments[1];
  std::ofstream(folder + "/height_predictor_rows.inc")
      << as_source("kRowPassRows", rows) << as_source("kColumnPassRows", columns);
  std::ofstream(folder + "/compact_mask_chances.inc") << train_mask(scans);
}

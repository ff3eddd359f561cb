// The report of `relief bench`.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_accuracy.h"
#include "renderer/bench/bench.h"

namespace relief::cli {

/// All measurements. The vectors have an entry for each row.
struct BenchResult {
  std::string scene;
  std::string view;  ///< its name in a scene file, or empty
  std::vector<RenderSettings> rows;
  std::string swept;                                ///< what --sweep varies, or empty
  std::vector<std::optional<double>> swept_values;  ///< of the rows; none: as converted by default
  std::vector<std::uint64_t> samples;               ///< of the rows' models
  std::size_t reference = 0;                        ///< the row whose covered pixels the bound has
  int frames = 0;
  int warm_up = 0;
  std::optional<std::uint64_t> mesh_triangles;  ///< of the input, if it has faces
  BenchReport times;
  std::vector<RowAccuracy> accuracy;
};

/// Returns the name of a row, with the value of a swept conversion: "onepass cell corrected
/// pixels-per-sample 4, spacing 0.01".
[[nodiscard]] std::string name_of_row(const BenchResult& result, std::size_t row);

/// Returns whether a row is the default of `relief render`, of a scan converted with default
/// options.
[[nodiscard]] bool is_default_row(const BenchResult& result, std::size_t row);

/// Returns one JSON object: the scene, the machine and a row for each method.
[[nodiscard]] nlohmann::ordered_json as_json(const BenchResult& result);

/// Returns a table as text, with a star at the default row.
[[nodiscard]] std::string as_text(const BenchResult& result);

}  // namespace relief::cli

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

/// What a row draws: samples of patches, or the points of scans (and the samples of patch files
/// among them).
enum class BenchInput : std::uint8_t { Samples, Points };

/// All measurements. The vectors have an entry for each row.
struct BenchResult {
  std::string scene;
  std::string view;  ///< its name in a scene file, or empty
  std::vector<RenderSettings> rows;
  std::string swept;                                ///< what --sweep varies, or empty
  std::vector<std::optional<double>> swept_values;  ///< of the rows; none: as converted by default
  std::vector<BenchInput> inputs;
  std::vector<std::uint64_t> samples;  ///< of the rows' models, or points
  std::size_t reference = 0;           ///< the row whose covered pixels the bound has, if there is
                                       ///< a bound
  bool compares_engines = false;       ///< --engines: rows are engines instead of methods
  bool truth_is_input = false;         ///< the faces of the files; else the patches' own triangles
  int frames = 0;
  int warm_up = 0;
  std::optional<std::uint64_t> mesh_triangles;  ///< of the input, if it has faces
  BenchReport times;
  std::vector<RowAccuracy> accuracy;
};

/// Returns the name of a row, with the value of a swept conversion: "onepass cell corrected
/// pixels-per-sample 4, spacing 0.01". Short where engines are compared.
[[nodiscard]] std::string name_of_row(const BenchResult& result, std::size_t row);

/// Returns whether a row is the default of `relief render`, of a scan converted with default
/// options.
[[nodiscard]] bool is_default_row(const BenchResult& result, std::size_t row);

/// A row relative to the others; nothing where there are none.
struct BenchRatios {
  std::optional<double> overdraw;      ///< fragments over covered pixels
  std::optional<double> to_multipass;  ///< the fastest unclipped row of kRivalEngine with default
                                       ///< numbers
  std::optional<double> to_bound;
  std::optional<double> to_mesh;
};
[[nodiscard]] BenchRatios ratios_of(const BenchResult& result, const BenchRow& row);

/// Returns one JSON object: the scene, the machine and a row for each method.
[[nodiscard]] nlohmann::ordered_json as_json(const BenchResult& result);

/// Returns a table as text, with a star at the default row.
[[nodiscard]] std::string as_text(const BenchResult& result);

}  // namespace relief::cli

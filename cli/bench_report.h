// What `relief bench` tells.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench_accuracy.h"
#include "renderer/bench/bench.h"

namespace relief::cli {

/// All that was measured. The vectors run parallel.
struct BenchResult {
  std::string scene;
  std::string view;  ///< its name in a scene file, or empty
  std::vector<RenderSettings> rows;
  std::size_t reference = 0;  ///< the row whose covered pixels the bound has
  int frames = 0;
  int warm_up = 0;
  std::uint64_t samples = 0;                    ///< of the model's patches
  std::optional<std::uint64_t> mesh_triangles;  ///< of the input, if it has faces
  BenchReport times;
  std::vector<RowAccuracy> accuracy;
};

/// The name of a row: "onepass quad corrected", "multipass sprite 2".
[[nodiscard]] std::string name_of_row(const RenderSettings& row);

/// The keys of DESIGN.md's `bench`, ratios, and what was asked for.
[[nodiscard]] nlohmann::ordered_json as_json(const BenchResult& result);

/// A table for a person, the default row marked by a star.
[[nodiscard]] std::string as_text(const BenchResult& result);

}  // namespace relief::cli

// The report of `relief convert`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.h"
#include "common/patch_file/patch_file.h"
#include "preprocess/convert_tiles.h"
#include "preprocess/points/outliers.h"
#include "preprocess/readers/read_points.h"

namespace relief::cli {

/// Everything that `relief convert` measured.
struct ConvertSummary {
  ReadResult read;  ///< its points are gone: they were converted
  OutlierReport outliers;
  std::uint64_t thinned = 0;
  ConvertReport report;
  PatchFileInfo file;
  std::optional<TiledResult> tiled;  ///< if it was converted in tiles
  double seconds = 0.0;
  std::vector<ConsoleProgress::Stage> stages;
};

[[nodiscard]] nlohmann::ordered_json convert_json(const ConvertSummary& summary);

/// Returns the summary as text.
[[nodiscard]] std::string convert_text(const ConvertSummary& summary,
                                       const std::filesystem::path& output);

}  // namespace relief::cli

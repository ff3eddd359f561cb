// `relief bench --sweep`: one quantity with several values.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"

namespace relief::cli {

struct Sweep {
  std::string key;  ///< kSpacing, kHeightStep, or a number among the options of engines on OpenGL
  std::vector<double> values;
};

/// Quantities of the conversion, in the scan's unit.
inline constexpr const char* kSpacing = "spacing";
inline constexpr const char* kHeightStep = "height-step";

/// The keys that can be swept.
[[nodiscard]] std::vector<std::string> sweep_keys();

/// "KEY=V,V,...", 1 to 16 values. Throws CLI::ValidationError.
[[nodiscard]] Sweep parse_sweep(const std::string& text);

/// Returns whether the scan is converted again for each value.
[[nodiscard]] inline bool converts(const Sweep& sweep) {
  return sweep.key == kSpacing || sweep.key == kHeightStep;
}

/// Converts a scan once for each value; all other options are the defaults.
Result<std::vector<PatchModel>> convert_sweep(const std::filesystem::path& scan, const Sweep& sweep,
                                              Progress& progress);

}  // namespace relief::cli

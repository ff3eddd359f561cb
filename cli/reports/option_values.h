// The values of engine options in reports.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "renderer/engine_registry.h"

namespace relief::cli {

/// The option of each key that an engine has, with _ for -: the value in force, or null if the
/// engine of these settings does not have it.
[[nodiscard]] nlohmann::ordered_json options_as_json(const RenderSettings& settings);

/// The engine's options that are among `keys`, or all: "cell, corrected, pixels-per-sample 4".
/// Numbers that are 0 are left out.
[[nodiscard]] std::vector<std::string> options_as_text(const RenderSettings& settings);
[[nodiscard]] std::vector<std::string> options_as_text(const RenderSettings& settings,
                                                       const std::vector<std::string>& keys);

}  // namespace relief::cli

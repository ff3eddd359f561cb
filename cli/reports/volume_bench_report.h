// The report of `relief bench` of volumes and 3D Gaussians.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/bench/volume_bench.h"

namespace relief::cli {

/// Returns one JSON object with the keys of other benches; null where there is no such thing.
[[nodiscard]] nlohmann::ordered_json as_json(const VolumeBench& result);

/// Returns a table as text, with a star at the default row. `scene`: its file's name.
[[nodiscard]] std::string as_text(const VolumeBench& result, const std::string& scene);

}  // namespace relief::cli

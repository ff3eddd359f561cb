// The options that the engines of volumes and 3D Gaussians share.
#pragma once

#include <vector>

#include "renderer/engine.h"

namespace relief {

[[nodiscard]] std::vector<EngineOption> volume_options();

/// pixels-per-node, of engines that splat.
[[nodiscard]] EngineOption coarse_option();

}  // namespace relief

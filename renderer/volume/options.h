// The options that the engines of volumes and 3D Gaussians share.
#pragma once

#include <vector>

#include "renderer/engine.h"

namespace relief {

[[nodiscard]] std::vector<EngineOption> volume_options();

}  // namespace relief

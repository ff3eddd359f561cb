// The options of clip partners, which the engines that splat surfaces share.
#pragma once

#include <vector>

#include "renderer/engine.h"

namespace relief {

/// `--clip-partners`, `--clip-threshold` and `--clip-normals`.
[[nodiscard]] std::vector<EngineOption> clip_options();

}  // namespace relief

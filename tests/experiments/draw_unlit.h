// How the engine `ewa` draws splats whose colours are to be compared.
#pragma once

#include <cstdint>

#include "common/error.h"
#include "common/image/image.h"
#include "common/scene/camera.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief::experiment {

/// The splats' colours, unlit; `side`: of the square image, in pixels.
Result<Image> draw_unlit(const SplatCloud& cloud, const Camera& camera, std::uint32_t side,
                         const EwaSettings& ewa);

}  // namespace relief::experiment

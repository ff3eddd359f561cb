// The engine `volume`: EWA volume splatting [Zwicker 2002] and 3D Gaussians [Kerbl 2023] on OpenGL,
// in single precision.
#pragma once

#include <memory>

#include "renderer/engine.h"

namespace relief::volume {

/// The outputs that images have beside the colour.
[[nodiscard]] Features features_of(const RenderSettings& settings, ModelMaps maps);

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::volume

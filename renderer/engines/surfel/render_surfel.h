// The engine `surfel`, from points to images.
#pragma once

#include <memory>

#include "common/error.h"
#include "renderer/engine.h"

namespace relief::surfel {

/// The feature bits of an image, of which `maps` decides nothing.
[[nodiscard]] Features features_of(const RenderSettings& settings, ModelMaps maps);

/// The model's points, or without any the samples of its patches. Surfels, programs and
/// environments are made by the first image that needs them. Gives a GlPreparedModel.
Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::surfel

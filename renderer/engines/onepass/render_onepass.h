// The engine `onepass`, from a model to its images.
#pragma once

#include <memory>

#include "common/error.h"
#include "renderer/engine.h"

namespace relief::onepass {

/// Uploads what at least one of the views reads of the model: its heights, normals, colours.
/// Programs and environments are made by the first image that needs them. Gives a GlPreparedModel.
Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::onepass

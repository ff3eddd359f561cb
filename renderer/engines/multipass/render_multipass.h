// The engine `multipass`, from its OpenGL context to its pictures.
#pragma once

#include <memory>
#include <span>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/prepared.h"
#include "renderer/render.h"

namespace relief::multipass {

/// Makes a context and uploads what at least one of the views reads of the model: its heights,
/// normals, colours. Programs and environments are made by the first picture that needs them. All
/// views have the same platform and debug flag.
Result<std::unique_ptr<PreparedModel>> prepare(const PatchModel& model,
                                               std::span<const RenderSettings> views);

}  // namespace relief::multipass

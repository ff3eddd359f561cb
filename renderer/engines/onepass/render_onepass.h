// A frame of the engine `onepass`, from its OpenGL context to its picture.
#pragma once

#include "common/error.h"
#include "common/patch.h"
#include "renderer/render.h"

namespace relief::onepass {

/// See render() in renderer/render.h.
Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings);

}  // namespace relief::onepass

// The engine `onepass`, from a model to its pictures.
#pragma once

#include <memory>
#include <span>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/gl/open_gl.h"
#include "renderer/render.h"

namespace relief::onepass {

/// Uploads what at least one of the views reads of the model: its heights, normals, colours.
/// Programs and environments are made by the first picture that needs them.
Result<std::unique_ptr<GlPreparedModel>> prepare(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views);

}  // namespace relief::onepass

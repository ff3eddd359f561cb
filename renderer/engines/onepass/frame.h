// One picture of the engine `onepass`: its targets, its uniforms, its frames and their times.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "common/error.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/environment.h"
#include "renderer/gl/functions.h"
#include "renderer/render.h"
#include "renderer/targets.h"
#include "renderer/view.h"

namespace relief::onepass {

/// What a frame draws with; made for several pictures and outliving them.
struct FrameParts {
  const Engine& engine;
  const Engine& counting;              ///< the same, but that it counts fragments
  const Texture* environment;          ///< for mirrors and the backdrop, or null
  const Backdrop* backdrop = nullptr;  ///< null: there is none in the picture
};

/// Draws a picture: once to count fragments, once to warm up, then `settings.frames` times for the
/// clock. `near` as for make_view. Fails if the picture is larger than OpenGL allows.
Result<RenderResult> draw_picture(const Gl& gl, const FrameParts& parts,
                                  const RenderSettings& settings, double near);

}  // namespace relief::onepass

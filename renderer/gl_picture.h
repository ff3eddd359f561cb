// One picture of an engine on OpenGL: its targets, its uniforms, its frames and their times.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>

#include "common/error.h"
#include "renderer/environment.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/pass.h"
#include "renderer/render.h"
#include "renderer/targets.h"
#include "renderer/view.h"

namespace relief {

/// What belongs to a picture, whatever engine draws it.
struct GlPicture {
  View view;
  Targets targets;
  Buffer uniforms;  ///< shared::Frame
  glm::vec3 background{0.0F};
  const Texture* environment = nullptr;         ///< what materials reflect, or null
  const Texture* rough_environments = nullptr;  ///< with several materials, some of them rough
  std::optional<Buffer> materials;              ///< shared::MaterialInfo of several materials
  const Texture* surroundings = nullptr;        ///< for the backdrop, or null
  const Backdrop* backdrop = nullptr;           ///< null: there is none in the picture
};

/// Draws the model of one frame. The targets are bound and cleared, the frame uniforms bound.
using DrawModel = std::function<void(const GlPicture& picture, PassTimer& timer)>;

/// Draws a picture: once with `count`, which counts fragments, once to warm up, then
/// `settings.frames` times for the clock.
Result<RenderResult> draw_picture(const Gl& gl, const GlPicture& picture, const DrawModel& draw,
                                  const DrawModel& count, const RenderSettings& settings);

}  // namespace relief

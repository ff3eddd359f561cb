// The lights of a scene as shaders take them.
#pragma once

#include "common/scene/light.h"
#include "renderer/view/view.h"
#include "shaders/include/shared.h"

namespace relief {

/// How many lights there are: those of the scene, or the camera's three.
[[nodiscard]] int count_lights(const Lights& lights);

/// Puts the lights into the uniforms of a frame: directions in the world, points relative to the
/// eye, so that single precision is enough wherever in the world they are.
void set_lights(shared::Frame& frame, const View& view, const Lights& lights);

}  // namespace relief

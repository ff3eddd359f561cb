// What two looks differ in.
#pragma once

#include <string>
#include <vector>

#include "common/scene/scene.h"
#include "renderer/settings.h"

namespace relief {

/// A quantity, and what it is in each of two looks: texts for the user.
struct Difference {
  std::string what;
  std::string first;
  std::string second;
};

/// A look as it is asked for, and as it is drawn.
struct LookInForce {
  const SceneSettings& asked;
  const RenderSettings& drawn;
};

/// Returns what differs in the images, the most telling first: materials and their parameters,
/// engines and their options, light, background, exposure. Not the camera, nor what follows from
/// another difference.
[[nodiscard]] std::vector<Difference> differences_of(const LookInForce& first,
                                                     const LookInForce& second);

}  // namespace relief

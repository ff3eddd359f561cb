// What the rule of Wicke keeps of a splat, for comparison (renderer/clip/wicke.h).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "renderer/clip/clip_partners.h"
#include "renderer/engines/ewa/clip_lines.h"
#include "renderer/view/view.h"

namespace relief::ewa {

/// A splat and the planes of its partners, world frame.
struct WickeSplat {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};  ///< unit
  std::span<const PartnerPlane> planes;
};

/// The share of what a pixel sees of a splat that is not clipped by the two partners nearest to
/// where the pixel's ray meets its plane. `lines`: of the partners; `offset`: of the pixel's middle
/// from the kernel's centre; `pixel`: that middle, from the upper left corner.
[[nodiscard]] KeptShare wicke_share(const WickeSplat& splat, std::span<const ImageLine> lines,
                                    const View& view, glm::dvec2 pixel, glm::dvec2 offset);

}  // namespace relief::ewa

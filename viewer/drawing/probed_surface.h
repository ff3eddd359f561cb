// Where the surface of a probed pixel is.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/image/image.h"
#include "viewer/session.h"

namespace relief {

/// A point of the surface on the ray through the middle of a pixel, as precise as a float depth.
struct ProbedSurface {
  glm::dvec3 start{0.0};      ///< of the ray, world
  glm::dvec3 direction{0.0};  ///< as ray_through() has it
  double depth = 0.0;         ///< along the ray, in lengths of `direction`
  double pixel = 0.0;         ///< how high a pixel is there, world units

  [[nodiscard]] glm::dvec3 position() const { return start + depth * direction; }
};

/// Returns the surface that Display::probe() has found under a cursor; nothing beside the model.
[[nodiscard]] std::optional<ProbedSurface> surface_of(const Image& pixel, const Session& session,
                                                      glm::dvec2 cursor);

}  // namespace relief

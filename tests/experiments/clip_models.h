// Solids with sharp features, whose surface is known exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "renderer/clip/clip_partners.h"

namespace relief::experiment {

/// A part of the surface that is smooth: positions for two coordinates from 0 to 1.
struct SmoothFace {
  std::function<glm::dvec3(double, double)> at;
  double area = 0.0;        ///< of the whole square; about
  double coarseness = 1.0;  ///< spacing, in multiples of the model's
};

/// A solid. Its faces may go beyond its surface.
struct SharpModel {
  std::string name;
  std::function<double(glm::dvec3)> height;  ///< above the surface; distance near it
  std::vector<SmoothFace> faces;
};

/// A position on a surface.
struct SurfacePoint {
  glm::dvec3 position;
  glm::dvec3 normal;
  std::uint32_t face;
};

/// All models, about 2 units large.
[[nodiscard]] std::vector<SharpModel> sharp_models();

/// Points that are no nearer to each other than the spacing on one face, as many as find room.
[[nodiscard]] std::vector<SurfacePoint> even_points(const SharpModel& model, double spacing,
                                                    std::uint64_t seed);

/// Points at random, evenly on average.
[[nodiscard]] std::vector<SurfacePoint> random_points(const SharpModel& model, std::size_t count,
                                                      std::uint64_t seed);

}  // namespace relief::experiment

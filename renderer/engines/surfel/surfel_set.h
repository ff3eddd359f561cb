// The surfels that an engine draws: where they are, how large, how they bend.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/progress.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/surfels/settings.h"

namespace relief::surfel {

/// A surfel's disc, world axes.
struct Axes {
  glm::vec3 u{0.0F};  ///< as long as the radius
  glm::vec3 v{0.0F};
};

/// Surfels of a cloud, by slot. Slots of points that cannot be drawn do not exist.
struct SurfelSet {
  std::vector<std::uint32_t> points;  ///< of the cloud, whose attributes they have
  std::vector<glm::dvec3> positions;  ///< world
  std::vector<glm::vec3> normals;     ///< world, unit
  std::vector<float> radii;           ///< world units; above 0 and finite
  std::vector<Axes> axes;
  /// The second fundamental form in radii: xx, xy, yy of the height over the disc of radius 1,
  /// which is half of what they make of an offset.
  std::vector<glm::vec3> bends;
  Bounds bounds;              ///< of the discs
  double typical_radius = 0;  ///< their median
};

/// Makes them. Points whose position or normal is not finite, or whose radius is not above 0 or
/// beyond kLargestRadius, are left out. Fails only if it is interrupted.
Result<SurfelSet> make_surfel_set(const SplatCloud& cloud, const SurfelSettings& settings,
                                  Progress& progress);

/// Twice this is still a float whose square is one.
inline constexpr double kLargestRadius = 1e15;

/// The steepest slope at a surfel's rim: a hemisphere's at 45 degrees. Normals of noise would fold
/// surfels up.
inline constexpr float kSteepestRim = 1.0F;

}  // namespace relief::surfel

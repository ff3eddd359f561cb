// Surfels: sized discs with a bend, found from points and normals alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/surfels/settings.h"

namespace relief {

/// The diameters of surfels, world units, for a scale of 1, and what was found on the way.
struct SurfelSizes {
  std::vector<double> diameters;        ///< of each point; above 0
  std::size_t triangles = 0;            ///< clusters of three points that are not collinear
  std::size_t leftovers = 0;            ///< points of other clusters
  std::vector<std::uint32_t> clusters;  ///< of each point; the clusters of the BSP, else empty
};

/// Finds the diameters from the positions alone, [Textured surfels], section 3.3. `normals`, of
/// length 1, are for cells of discs that are clipped at sharp edges (cell_sizes.h); empty: they are
/// not. Where points are
/// duplicates, or too few for any triangle, the rule is stated at the definition. Fails only if it
/// is interrupted.
Result<SurfelSizes> find_surfel_sizes(std::span<const glm::dvec3> positions,
                                      std::span<const glm::vec3> normals, SurfelSize method,
                                      Progress& progress);

/// The factor of the diameters that leaves at most 0.001 % of a surface bare, as measured on
/// surfaces that are known, sampled evenly and unevenly (docs/measurements/surfels.md).
[[nodiscard]] double closing_scale(SurfelSize method);

/// How a surfel bends: its height over the tangent plane at offset (x, y) along its axes is
/// (bend.x x^2 + 2 bend.y x y + bend.z y^2) / 2, world units: the second fundamental form by the
/// neighbours' normals. The axes are those of its principal curvatures, the stronger first.
struct SurfelFrame {
  glm::dvec3 u{0.0};  ///< unit, in the tangent plane
  glm::dvec3 v{0.0};  ///< unit, n = u x v
  glm::dvec3 bend{0.0};
};

/// The frames of surfels, whose radii bound where neighbours count.
Result<std::vector<SurfelFrame>> find_surfel_frames(std::span<const glm::dvec3> positions,
                                                    std::span<const glm::vec3> normals,
                                                    std::span<const double> radii,
                                                    Progress& progress);

}  // namespace relief

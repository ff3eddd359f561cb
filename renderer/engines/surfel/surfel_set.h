// The surfels that an engine draws: where they are, how large, how they bend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/progress.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/surfels/settings.h"
#include "renderer/surfels/sphere_tree.h"

namespace relief::surfel {

/// A surfel's disc, world axes.
struct Axes {
  glm::vec3 u{0.0F};  ///< as long as the radius
  glm::vec3 v{0.0F};
};

/// Surfels by slot: those of points, in the order of the tree, and behind them the mean surfels of
/// the tree's nodes, which stand for theirs from afar. Points that can't be drawn have none.
struct SurfelSet {
  std::size_t own = 0;                ///< slots of points
  std::vector<std::uint32_t> points;  ///< of the cloud; of a node one that it stands for
  std::vector<glm::dvec3> positions;  ///< world
  std::vector<glm::vec3> normals;     ///< world, unit
  std::vector<float> radii;           ///< world units; above 0 and finite
  std::vector<Axes> axes;
  /// The second fundamental form in radii: the height over the disc of radius 1 is
  /// (x xx + 2 y xy + z yy) / 2. Of nodes 0.
  std::vector<glm::vec3> bends;
  std::vector<glm::vec4> colours;    ///< linear; empty if the cloud has none
  std::vector<glm::mat2> gradients;  ///< of texture coordinates along the axes; empty likewise
  SphereTree tree;
  Bounds bounds;  ///< of what is drawn
};

/// Makes them. `clipped`: clip lines will end them at sharp edges. Points whose position is not
/// finite, whose normal has no direction, or whose radius is not above 0 or beyond kLargestRadius,
/// are left out. Fails only if it is interrupted.
Result<SurfelSet> make_surfel_set(const SplatCloud& cloud, const SurfelSettings& settings,
                                  bool clipped, Progress& progress);

/// Twice this is still a float whose square is one.
inline constexpr double kLargestRadius = 1e15;

/// The steepest slope at a surfel's rim: a sphere's at 45 degrees. Normals of noise would fold
/// surfels up.
inline constexpr float kSteepestRim = 1.0F;

/// The steepest slope at a surfel's rim, at most; 0: it is flat.
[[nodiscard]] float rim_slope(glm::vec3 bend);

/// How far a bent surfel reaches, over its radius: kSteepestRim lifts its rim by half of that.
inline constexpr float kBentReach = 1.12F;

}  // namespace relief::surfel

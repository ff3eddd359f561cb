#include "preprocess/normals/sampled_sides.h"

#include <array>
#include <limits>

namespace relief {

glm::vec3 SampledSides::normal_near(glm::dvec3 position) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  tree_.visit_near(
      position, [&nearest] { return nearest; },
      [&](std::size_t first, std::size_t count) {
        std::array<double, PositionTree::kLeafSize> squared;
        tree_.squared_distances(position, first, squared);
        for (std::size_t m = 0; m < count; ++m) {
          if (squared[m] >= nearest) continue;
          nearest = squared[m];
          found = tree_.index(first + m);
        }
      });
  return normals_[found];
}

}  // namespace relief

// The patch nearest to a point, among thousands.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/patch.h"

namespace relief {

/// Boxes about patches in a binary tree. Trying all patches for each of many points that none
/// covers took 20 s of 26 for 65,000 points and 13,600 patches (100 textured quads in a stack).
class NearestPatch {
 public:
  /// Keeps a reference to the patches.
  explicit NearestPatch(const std::vector<Patch>& patches);

  /// Returns the smallest distance_to_patch (preprocess/measure/patch_distance.h) of a point, or
  /// `best` if no patch is nearer. World units. Equal to trying all of them.
  [[nodiscard]] double distance(glm::dvec3 point, double best) const;

 private:
  /// What a distance to some patches is at least: that to their box, over their steepness, because
  /// distances to a cell are measured to its tangent plane.
  struct Reach {
    Bounds box;
    double steepness = 1.0;  ///< at least 1
  };
  struct Node {
    Reach reach;
    std::uint32_t first = 0;  ///< of a leaf: in `order_`; else the left child, beside the right one
    std::uint32_t count = 0;  ///< of a leaf's patches; 0: no leaf
  };

  [[nodiscard]] static Reach reach_of(const Patch& patch);
  [[nodiscard]] static double least_distance(const Reach& reach, glm::dvec3 point);
  void build(const std::vector<Reach>& reaches, std::uint32_t node, std::uint32_t first,
             std::uint32_t count);

  const std::vector<Patch>& patches_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace relief

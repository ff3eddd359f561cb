// The sides of a whole scan, for parts of it that cannot tell their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Points of a scan that chance has chosen, spread over all of it: every n-th point would lie in
/// the scanner's lines. The same for the same points in the same order.
class ChanceSample {
 public:
  static constexpr std::size_t kMost = std::size_t{1} << 18U;

  void add(glm::dvec3 point);
  [[nodiscard]] std::vector<glm::dvec3> take();

 private:
  struct Chosen {
    std::uint64_t lot = 0;
    glm::dvec3 point{0.0};
  };
  std::vector<Chosen> chosen_;
  std::uint64_t seen_ = 0;
  std::uint64_t mask_ = 0;  ///< points are chosen whose lot has none of these bits
};

/// Normals of a sample of a scan, for parts of it (orient_sample()).
class SampledSides {
 public:
  /// At least one point, finite, in the frame of the parts. `normals`: unit.
  SampledSides(const std::vector<glm::dvec3>& points, std::vector<glm::vec3> normals)
      : tree_(points), normals_(std::move(normals)) {}

  /// The normal of the nearest sampled point.
  [[nodiscard]] glm::vec3 normal_near(glm::dvec3 position) const;

 private:
  PositionTree tree_;
  std::vector<glm::vec3> normals_;  ///< by index in the tree
};

}  // namespace relief

// Regions of points, one a patch.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace relief {

/// Points that share a patch.
struct Region {
  std::vector<std::uint32_t> points;  ///< ascending
  glm::vec3 normal{0.0F};             ///< of the base plane, unit
};

/// The membership of points in regions.
struct Membership {
  std::vector<std::uint32_t>
      region;  ///< index of the region; the number of regions if the point is in none
  std::vector<float> cosine;  ///< of the angle between the point's normal and the base-plane normal
                              ///< of its region; 1 if it is in none
  /// Points from this one on are of other tiles, whose regions are not known.
  std::uint32_t of_others = std::numeric_limits<std::uint32_t>::max();
};

}  // namespace relief

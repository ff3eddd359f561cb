// The outermost normals of a set, for a quick test that no cone of a given width holds them all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace relief {

/// The unit normals of a set that extend farthest in each of 64 directions. Large sets are sampled
/// evenly, which keeps a negative answer exact.
class NormalSpread {
 public:
  NormalSpread(const std::vector<glm::vec3>& normals, std::span<const std::uint32_t> points);

  /// Adds the normals of another set.
  void add(const NormalSpread& other);

  /// Returns true only if no cone of this half angle holds all normals of both sets, so that the
  /// test of all normals (RegionTest) can be skipped. False decides nothing.
  [[nodiscard]] static bool exceed(const NormalSpread& a, const NormalSpread& b, double cos_cone);

 private:
  static constexpr std::size_t kDirections = 64;
  std::array<glm::vec3, kDirections> outermost_;
};

}  // namespace relief

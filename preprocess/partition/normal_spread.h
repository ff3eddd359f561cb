// The outermost of a set of normals, which tell that no cone of a given width holds them all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace relief {

/// Of a set of unit normals those that go farthest in each of 64 directions; of a large set those
/// of an even sample, which can tell no less surely that a cone does not hold them.
class NormalSpread {
 public:
  NormalSpread(const std::vector<glm::vec3>& normals, std::span<const std::uint32_t> points);

  /// Takes the normals of another set in.
  void add(const NormalSpread& other);

  /// True only if no cone of this half angle has all normals of both sets in it; then the test of
  /// all of them (RegionTest) need not be made. Where it is false, that may still be so.
  [[nodiscard]] static bool exceed(const NormalSpread& a, const NormalSpread& b, double cos_cone);

 private:
  static constexpr std::size_t kDirections = 64;
  std::array<glm::vec3, kDirections> outermost_;
};

}  // namespace relief

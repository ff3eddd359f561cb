// The points around one, in rings of growing radius.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Points around a centre by distance. Lengths are in units, the scan's spacing at the centre.
class Rings {
 public:
  /// Number of rings. Each disc holds 1.5 times as many points as the one before: 11 to 650 on an
  /// evenly sampled plane.
  static constexpr std::size_t kCount = 11;
  /// The radius of the disc that ends with a ring.
  static double radius(std::size_t ring);
  static double squared_radius(std::size_t ring);

  struct Neighbour {
    glm::dvec3 offset;  ///< from the centre
    std::uint32_t slot;
  };

  explicit Rings(const PositionTree& tree) : tree_(tree) {}

  /// Collects the points about a centre in the first `rings` rings; `unit`: the spacing there,
  /// world units. With more rings the points of the first are the same, in the same order.
  void collect(const glm::dvec3& centre, double unit, std::size_t rings = kCount);

  /// The number of rings; fewer than asked for if the points about the centre are far denser than
  /// its spacing says, which bounds the work.
  [[nodiscard]] std::size_t count() const { return count_; }
  /// The points of one ring, in the tree's order. The innermost holds the centre itself.
  [[nodiscard]] std::span<const Neighbour> of(std::size_t ring) const {
    return std::span(neighbours_).subspan(ends_[ring], ends_[ring + 1] - ends_[ring]);
  }
  /// The points of the rings up to one.
  [[nodiscard]] std::span<const Neighbour> up_to(std::size_t ring) const {
    return std::span(neighbours_).first(ends_[ring + 1]);
  }

 private:
  bool collect_within(const glm::dvec3& centre, double unit, std::size_t rings);
  void sort_by_ring(std::size_t rings);

  const PositionTree& tree_;
  std::size_t count_ = 0;
  std::vector<Neighbour> found_;
  std::vector<std::uint8_t> ring_of_;
  std::vector<Neighbour> neighbours_;           // by ring
  std::array<std::size_t, kCount + 1> ends_{};  // of the rings before
};

}  // namespace relief

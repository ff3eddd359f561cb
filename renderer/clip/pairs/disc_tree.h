// Which discs a disc may touch: a kd-tree of discs of any radii.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/clip/clip_partners.h"

namespace relief {

/// A disc as the classification takes it.
struct Disc {
  glm::dvec3 centre;
  glm::dvec3 normal;  ///< unit
  double radius;      ///< of ellipses the major semi-axis
  std::uint32_t splat;
};

/// The discs of some splats, found by place. Leaves out discs that have no place, no normal or no
/// area (NaN, zero vectors, radii of zero or below), so they have no neighbours.
class DiscTree {
 public:
  explicit DiscTree(const SplatDiscs& discs);

  /// Discs in the order of the tree: near ones are near in memory.
  [[nodiscard]] const std::vector<Disc>& discs() const { return discs_; }

  /// Takes other normals, unit, of each slot.
  void set_normals(const std::vector<glm::dvec3>& normals);

  /// Appends the slots (in `discs()`) of the neighbours of a disc, Eq. (1) of [Ivo 2011] as
  /// corrected: those whose centres are nearer than the sum of both radii. Itself is none. Looks
  /// near the disc first, and at no more than `most_tested` discs, so that many coincident discs
  /// take bounded time. Returns whether it saw all.
  bool neighbours(std::size_t slot, std::size_t most_tested,
                  std::vector<std::uint32_t>& slots) const;

 private:
  struct Node {
    glm::dvec3 low;
    glm::dvec3 high;
    double max_radius;
    std::uint32_t begin;
    std::uint32_t end;
  };

  void build(std::size_t node, std::uint32_t begin, std::uint32_t end);
  [[nodiscard]] bool is_leaf(std::size_t node) const { return 2 * node + 2 >= nodes_.size(); }

  std::vector<Disc> discs_;
  std::vector<Node> nodes_;  // a full binary tree: the children of k are 2k + 1 and 2k + 2
};

}  // namespace relief

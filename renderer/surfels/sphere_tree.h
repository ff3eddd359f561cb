// A hierarchy of spheres over surfels [Rusinkiewicz 2000]: for culling, and for drawing fewer
// surfels from afar.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/view/view.h"

namespace relief {

/// A sphere about surfels, the cone of their normals, and the one surfel that stands for them from
/// afar. World frame.
struct SphereNode {
  glm::dvec3 centre{0.0};
  double radius = 0.0;       ///< the sphere holds all that is drawn of its surfels
  glm::vec3 axis{0.0F};      ///< unit; the middle of the cone of normals, and the mean's normal
  float cos_angle = -1.0F;   ///< of the cone's half angle; -1: it holds all directions
  glm::dvec3 mean{0.0};      ///< the mean of the positions
  double mean_radius = 0.0;  ///< of the disc about `mean` that holds them, seen along `axis`
  /// The least `mean_radius` of it and the nodes below it that hold more than one surfel; infinite
  /// if none does.
  double least_mean_radius = std::numeric_limits<double>::infinity();
  std::uint32_t first = 0;     ///< its surfels in SphereTree::order
  std::uint32_t count = 0;     ///< at least 1
  std::uint32_t child = 0;     ///< its first child; its others follow
  std::uint32_t children = 0;  ///< 2 to 4; 0: a leaf
};

/// The surfels of a node are one piece of `order`, those of its children pieces of that.
struct SphereTree {
  /// At most this many surfels make a leaf; only of coincident positions do more.
  static constexpr std::uint32_t kLeafSize = 4;

  std::vector<SphereNode> nodes;  ///< breadth first, the root first; empty without surfels
  /// The surfels by slot. A renderer stores them in this order, so that what it draws is runs.
  std::vector<std::uint32_t> order;
};

/// Surfels as the hierarchy takes them; spans are as long as `positions`, or empty where said.
struct SphereSurfels {
  std::span<const glm::dvec3> positions;  ///< finite
  std::span<const glm::vec3> normals;     ///< unit; any other: the surfel is seen from both sides
  /// How far each is drawn from its position, world units: the radius of a disc, more of a polygon
  /// about it or of a bent surfel.
  std::span<const double> reaches;
  /// How far, in radians, the normals of a bent surfel stray from its own; empty: none is bent.
  std::span<const float> spreads;
};

/// Builds the hierarchy: nodes are split in the middle of the longest side of their box, twice a
/// level, so that they have two to four children, three on average. The result does not depend on
/// the number of threads. Fails only if it is interrupted.
Result<SphereTree> build_sphere_tree(const SphereSurfels& surfels, Progress& progress);

/// The mean of an attribute over the surfels of each node, as long as `nodes`. `of_surfel`: in the
/// order of the surfels' indices, not of slots. T can be added and multiplied by a float.
template <class T>
[[nodiscard]] std::vector<T> mean_by_node(const SphereTree& tree, std::span<const T> of_surfel) {
  assert(of_surfel.size() == tree.order.size() && "an attribute of each surfel");
  std::vector<T> means(tree.nodes.size(), T(0.0F));
  for (std::size_t n = tree.nodes.size(); n-- > 0;) {  // children come after their parents
    const SphereNode& node = tree.nodes[n];
    const float whole = 1.0F / static_cast<float>(node.count);
    for (std::uint32_t c = node.child; c < node.child + node.children; ++c)
      means[n] += means[c] * (static_cast<float>(tree.nodes[c].count) * whole);
    if (node.children > 0) continue;
    for (const std::uint32_t k : std::span(tree.order).subspan(node.first, node.count))
      means[n] += of_surfel[k] * whole;
  }
  return means;
}

/// What of a hierarchy is drawn.
struct CutRule {
  bool frustum = true;  ///< leave out what the image does not show
  bool backs = true;    ///< leave out what shows only backs
  /// Draw the mean surfel of a node whose disc is seen at most so many pixels wide; 0: never.
  double pixels = 0.0;
  /// Nodes of at most so many surfels are not divided to leave out a part of them.
  std::uint32_t fewest = 64;
};

/// `count` slots or nodes from `first` on.
struct SurfelRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// What is drawn: runs are ascending, and do not touch.
struct SphereCut {
  std::vector<SurfelRun> surfels;  ///< of slots
  std::vector<SurfelRun> nodes;    ///< of nodes whose mean surfel is drawn instead
  std::uint64_t outside = 0;       ///< surfels that were left out, by reason
  std::uint64_t facing_away = 0;   ///< those only whose whole node faces away
  std::uint64_t visited = 0;       ///< nodes
};

/// Chooses what a view draws. What is left out shows nothing: neither of its discs nor, with
/// CutRule::backs, of a front of one.
[[nodiscard]] SphereCut cut_sphere_tree(const SphereTree& tree, const View& view,
                                        const CutRule& rule);

}  // namespace relief

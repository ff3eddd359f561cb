#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/surfels/sphere_tree.h"

namespace relief {
namespace {

/// Whether all points of a node's sphere, with all normals of its cone, show their backs.
bool faces_away(const View& view, const SphereNode& node) {
  const double half_angle = std::acos(std::clamp(double{node.cos_angle}, -1.0, 1.0));
  const glm::dvec3 axis(node.axis);
  if (view.orthographic) {
    const glm::dvec3 forward = -glm::transpose(view.rotation)[2];
    return half_angle < std::acos(0.0) && glm::dot(axis, forward) > std::sin(half_angle);
  }
  const glm::dvec3 to_centre = node.centre - view.eye;
  const double distance = glm::length(to_centre);
  if (!(distance > node.radius)) return false;
  const double strayed = half_angle + std::asin(node.radius / distance);
  return strayed < std::acos(0.0) && glm::dot(axis, to_centre) > distance * std::sin(strayed);
}

void append_run(std::vector<SurfelRun>& runs, std::uint32_t first, std::uint32_t count) {
  if (!runs.empty() && runs.back().first + runs.back().count == first) {
    runs.back().count += count;
  } else {
    runs.push_back({first, count});
  }
}

class Cutter {
 public:
  Cutter(const SphereTree& tree, const View& view, const CutRule& rule)
      : tree_(tree), view_(view), rule_(rule) {}

  SphereCut cut() {
    if (!tree_.nodes.empty()) visit(0);
    std::ranges::sort(means_);
    for (const std::uint32_t node : means_) append_run(cut_.nodes, node, 1);
    return std::move(cut_);
  }

 private:
  /// Children are visited in the order of their slots, so that runs ascend.
  void visit(std::uint32_t index) {
    const SphereNode& node = tree_.nodes[index];
    ++cut_.visited;
    if (rule_.frustum && !sees_sphere(view_, node.centre, node.radius)) {
      cut_.outside += node.count;
      return;
    }
    if (rule_.backs && faces_away(view_, node)) {
      cut_.facing_away += node.count;
      return;
    }
    if (is_small(node)) return means_.push_back(index);
    const bool is_undivided = node.count <= rule_.fewest && !has_small(node);
    if (node.children == 0 || is_undivided) return append_run(cut_.surfels, node.first, node.count);
    for (std::uint32_t c = 0; c < node.children; ++c) visit(node.child + c);
  }

  /// A single surfel is drawn as it is; surfels that face all ways have no mean.
  [[nodiscard]] bool is_small(const SphereNode& node) const {
    return rule_.pixels > 0.0 && node.count > 1 && node.cos_angle > 0.0F &&
           2.0 * node.mean_radius <= rule_.pixels * nearest_pixel(view_, node.centre, node.radius);
  }

  /// Whether a node below may be small: no pixel of its own is larger than where this one is
  /// farthest. Without this near views visited all nodes, 150,000 of the Dragon's, to find none.
  [[nodiscard]] bool has_small(const SphereNode& node) const {
    return rule_.pixels > 0.0 && 2.0 * node.least_mean_radius <=
                                     rule_.pixels * nearest_pixel(view_, node.centre, -node.radius);
  }

  const SphereTree& tree_;
  const View& view_;
  const CutRule& rule_;
  SphereCut cut_;
  std::vector<std::uint32_t> means_;
};

}  // namespace

SphereCut cut_sphere_tree(const SphereTree& tree, const View& view, const CutRule& rule) {
  return Cutter(tree, view, rule).cut();
}

}  // namespace relief

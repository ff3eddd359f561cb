#include "preprocess/noise/move_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

// A centre is its own noise off the surface, and a window's is not exact either.
constexpr double kLikelyDeviations = 1.5;
// Beyond this many of them a window says nothing of a centre.
constexpr double kMostDeviations = 5.0;

/// The sum of what windows say of one centre.
struct Votes {
  double weight = 0.0;
  glm::dvec3 shift{0.0};
  glm::dvec3 normal{0.0};

  /// `noise`: the centre's, world units.
  void add(const NoiseWindow& window, const glm::dvec3& centre, double noise) {
    const glm::dvec3 offset = (centre - window.centre) / window.unit;
    const double share = glm::dot(offset, offset) / window.squared_radius;
    if (share >= 1.0) return;
    const QuadricDistance to = distance_to(window.quadric, offset);
    const double off = to.distance * window.unit / (kLikelyDeviations * noise);
    if (std::abs(off) > kMostDeviations) return;
    // The variance of a quadric over an evenly sampled disc, in that of a point over their number.
    const double variance = 4.0 - 8.0 * share + 18.0 * share * share;
    const double w = window.stands_for * window.points / variance * std::exp(-0.5 * off * off);
    weight += w;
    shift -= w * to.distance * window.unit * to.normal;
    normal += glm::dot(to.normal, normal) < 0.0 ? -w * to.normal : w * to.normal;
  }
};

/// Windows of similar size, by their own tree's slots, so that those about a centre lie together.
struct WindowTree {
  PositionTree tree;
  std::vector<NoiseWindow> windows;
  double largest_radius = 0.0;  ///< in their units
};

// Small windows are many, and reach few centres: looking for them as far as large ones reach took
// half of the time.
constexpr std::array<double, 3> kSquaredRadii = {20.0, 70.0, 1e300};

/// The windows of squared radii above one number, units, and up to another.
WindowTree tree_of(const std::vector<NoiseWindow>& windows, double above, double up_to) {
  std::vector<std::uint32_t> found;
  std::vector<glm::dvec3> centres;
  double squared = 0.0;
  for (std::uint32_t w = 0; w < windows.size(); ++w) {
    if (!(windows[w].squared_radius > above && windows[w].squared_radius <= up_to)) continue;
    found.push_back(w);
    centres.push_back(windows[w].centre);
    squared = std::max(squared, windows[w].squared_radius);
  }
  WindowTree tree{PositionTree(centres), {}, std::sqrt(squared)};
  tree.windows.reserve(found.size());
  for (std::uint32_t slot = 0; slot < found.size(); ++slot)
    tree.windows.push_back(windows[found[tree.tree.index(slot)]]);
  return tree;
}

std::vector<WindowTree> trees_of(const std::vector<NoiseWindow>& windows) {
  std::vector<WindowTree> trees;
  double above = 0.0;  // windows that do not exist have radius 0
  for (const double up_to : kSquaredRadii) {
    trees.push_back(tree_of(windows, above, up_to));
    above = up_to;
  }
  return trees;
}

/// What all windows say of a centre.
Votes votes_on(const NoiseWindow& own, const std::vector<WindowTree>& trees, double noise) {
  Votes votes;
  for (const WindowTree& tree : trees) {
    const double squared_reach = std::pow(tree.largest_radius * own.unit, 2.0);
    tree.tree.visit_near(
        own.centre, [squared_reach] { return squared_reach; },
        [&](std::size_t first, std::size_t leaf) {
          for (std::size_t w = first; w < first + leaf; ++w)
            votes.add(tree.windows[w], own.centre, noise);
        });
  }
  return votes;
}

}  // namespace

SmoothPoints move_points(const std::vector<NoiseWindow>& windows, const std::vector<float>& noise,
                         Progress& progress) {
  const auto count = static_cast<std::uint32_t>(windows.size());
  const std::vector<WindowTree> trees = trees_of(windows);
  SmoothPoints smooth{std::vector<glm::dvec3>(count), std::vector<glm::vec3>(count)};
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 64), [&](const auto& range) {
    if (progress.cancelled()) return;
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      const NoiseWindow& own = windows[slot];
      smooth.positions[slot] = own.centre;
      if (!(own.unit > 0.0)) continue;
      const Votes votes = votes_on(own, trees, noise[slot]);
      if (!(votes.weight > 0.0) || !(glm::length(votes.normal) > 0.0)) continue;
      smooth.positions[slot] = own.centre + votes.shift / votes.weight;
      smooth.normals[slot] = glm::vec3(glm::normalize(votes.normal));
    }
    progress.advance(range.size());
  });
  return smooth;
}

}  // namespace relief

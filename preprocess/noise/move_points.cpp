#include "preprocess/noise/move_points.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
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
  void add(const Window& window, const glm::dvec3& centre, double noise) {
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

/// The windows that exist, by their own tree's slots, so that those about a centre lie together.
struct WindowTree {
  PositionTree tree;
  std::vector<Window> windows;
  double largest_radius = 0.0;  ///< in their units
};

WindowTree tree_of(const std::vector<Window>& windows) {
  std::vector<std::uint32_t> existing;
  std::vector<glm::dvec3> centres;
  double squared = 0.0;
  for (std::uint32_t w = 0; w < windows.size(); ++w) {
    if (!windows[w].exists()) continue;
    existing.push_back(w);
    centres.push_back(windows[w].centre);
    squared = std::max(squared, windows[w].squared_radius);
  }
  WindowTree found{PositionTree(centres), {}, std::sqrt(squared)};
  found.windows.reserve(existing.size());
  for (std::uint32_t slot = 0; slot < existing.size(); ++slot)
    found.windows.push_back(windows[existing[found.tree.index(slot)]]);
  return found;
}

}  // namespace

SmoothPoints move_points(const std::vector<Window>& windows, const std::vector<float>& noise,
                         Progress& progress) {
  const auto count = static_cast<std::uint32_t>(windows.size());
  const WindowTree existing = tree_of(windows);
  SmoothPoints smooth{std::vector<glm::dvec3>(count), std::vector<glm::vec3>(count)};
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 64), [&](const auto& range) {
    if (progress.cancelled()) return;
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      const Window& own = windows[slot];
      smooth.positions[slot] = own.centre;
      if (!(own.unit > 0.0)) continue;
      Votes votes;
      const double squared_reach = std::pow(existing.largest_radius * own.unit, 2.0);
      existing.tree.visit_near(
          own.centre, [squared_reach] { return squared_reach; },
          [&](std::size_t first, std::size_t leaf) {
            for (std::size_t w = first; w < first + leaf; ++w)
              votes.add(existing.windows[w], own.centre, noise[slot]);
          });
      if (!(votes.weight > 0.0) || !(glm::length(votes.normal) > 0.0)) continue;
      smooth.positions[slot] = own.centre + votes.shift / votes.weight;
      smooth.normals[slot] = glm::vec3(glm::normalize(votes.normal));
    }
    progress.advance(range.size());
  });
  return smooth;
}

}  // namespace relief

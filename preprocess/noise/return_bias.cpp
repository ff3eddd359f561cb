#include "preprocess/noise/return_bias.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "preprocess/noise/rings.h"

namespace relief {
namespace {

// The mean is over a disc of 87 points, weighted as (1 - d^2 / r^2)^2, d their distance as
// smoothed: its noise is a seventh of a point's.
constexpr std::size_t kRings = 6;
// Noise alone makes a mean of so many of its standard deviations. With 0, 0.5 and 0.7 samples of a
// scan of ridges and valleys keep 0.89, 0.90 and 0.91 of their distance to the surface, those of a
// sphere with noise of one spacing 1.45, 1.33 and 1.27.
constexpr double kDeviationsOfMean = 0.7;
// Points whose normals turn by more than 45 degrees are of another surface.
constexpr float kLeastCosine = 0.7F;

/// How far each point was moved, against its normal, world units.
std::vector<float> residuals_of(const PositionTree& tree, const SmoothPoints& smooth) {
  std::vector<float> residuals(tree.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot)
    residuals[slot] = static_cast<float>(
        glm::dot(tree.at(slot) - smooth.positions[slot], glm::dvec3(smooth.normals[slot])));
  return residuals;
}

/// What a disc's points say of the bias at its centre, along the centre's normal, world units.
/// `unit`: the rings'; `noise`: the centre's.
double bias_at(std::uint32_t centre, const Rings& rings, double unit, double noise,
               const SmoothPoints& smooth, const std::vector<float>& residuals) {
  if (rings.count() == 0) return 0.0;
  const std::size_t last = rings.count() - 1;
  const double squared_radius = Rings::squared_radius(last) * unit * unit;
  double sum = 0.0;
  double weight = 0.0;
  double squared_weight = 0.0;
  for (const Rings::Neighbour& n : rings.up_to(last)) {
    const float cosine = glm::dot(smooth.normals[centre], smooth.normals[n.slot]);
    if (std::abs(cosine) < kLeastCosine) continue;
    const glm::dvec3 d = smooth.positions[n.slot] - smooth.positions[centre];
    const double inside = std::max(1.0 - glm::dot(d, d) / squared_radius, 0.0);
    const double w = inside * inside;
    sum += cosine < 0.0F ? -w * residuals[n.slot] : w * residuals[n.slot];
    weight += w;
    squared_weight += w * w;
  }
  if (sum == 0.0) return 0.0;
  // Of the mean, and of the noise in it.
  const double mean = sum / weight;
  const double likely = kDeviationsOfMean * noise * std::sqrt(squared_weight) / weight;
  return mean * std::max(1.0 - likely * likely / (mean * mean), 0.0);
}

}  // namespace

void return_bias(const PositionTree& tree, const std::vector<float>& spacing,
                 const std::vector<float>& noise, SmoothPoints& smooth, Progress& progress) {
  const std::vector<float> residuals = residuals_of(tree, smooth);
  std::vector<glm::dvec3> positions = smooth.positions;
  const auto count = static_cast<std::uint32_t>(tree.size());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, 64), [&](const auto& range) {
    if (progress.cancelled()) return;
    Rings rings(tree);
    for (std::uint32_t slot = range.begin(); slot != range.end(); ++slot) {
      if (smooth.normals[slot] == glm::vec3(0.0F)) continue;
      rings.collect(smooth.positions[slot], spacing[slot], kRings);
      positions[slot] += bias_at(slot, rings, spacing[slot], noise[slot], smooth, residuals) *
                         glm::dvec3(smooth.normals[slot]);
    }
    progress.advance(range.size());
  });
  smooth.positions = std::move(positions);
}

}  // namespace relief

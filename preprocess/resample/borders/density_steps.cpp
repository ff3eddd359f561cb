#include "preprocess/resample/borders/density_steps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace relief {
namespace {

// What goes on lies near the tangent plane: what is behind is another surface.
constexpr double kSteepest = 0.5;

}  // namespace

DensitySteps::DensitySteps(const SurfaceSamples& samples, const NeighbourGraph& graph)
    : samples_(samples) {
  const auto count = static_cast<std::uint32_t>(samples.positions.size());
  const auto has_neighbour = [&](std::uint32_t i, const auto& is) {
    return std::ranges::any_of(graph.of(i), is);
  };
  std::vector<std::uint8_t> at_step(count, 0);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
    at_step[i] = has_neighbour(i, [&](std::uint32_t j) {
      return samples.spacing[j] > 0.0F && kDensityStep * samples.spacing[j] < samples.spacing[i];
    });
  });
  if (std::ranges::count(at_step, std::uint8_t{1}) == 0) return;
  // The nearest points of one at a step are dense, so that its spacing says too little of the
  // sparse part; those beyond it have that of the sparse part.
  std::map<int, std::vector<std::uint32_t>> octaves;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (at_step[i] != 0 || has_neighbour(i, [&](std::uint32_t j) {
          return at_step[j] != 0 && samples.spacing[j] <= samples.spacing[i];
        }))
      octaves[std::ilogb(samples.spacing[i])].push_back(i);
  }
  for (auto& [exponent, points] : octaves) {
    std::vector<glm::dvec3> positions;
    for (const std::uint32_t i : points) positions.push_back(samples.positions[i]);
    octaves_.push_back(
        {kWidestGap * std::ldexp(1.0, exponent + 1), std::move(points), RadiusSearch(positions)});
  }
}

bool DensitySteps::go_on(std::uint32_t point, glm::dvec3 outward) const {
  const glm::dvec3 from = samples_.positions[point];
  const glm::dvec3 normal(samples_.normals[point]);
  return std::ranges::any_of(octaves_, [&](const Octave& octave) {
    return octave.search.any(from, octave.reach, [&](std::uint32_t found) {
      const std::uint32_t j = octave.points[found];
      const double gap = kWidestGap * samples_.spacing[j];  // its own: it is the sparser one
      const glm::dvec3 d = samples_.positions[j] - from;
      const double across = glm::dot(d, normal);
      const double within = glm::length(d - across * normal);
      return glm::dot(d, d) <= gap * gap && glm::dot(d, outward) >= kGapCosine * within &&
             within > 0.0 && std::abs(across) <= kSteepest * within;
    });
  });
}

}  // namespace relief

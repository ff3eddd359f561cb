#include "preprocess/points/sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace relief {
namespace {

constexpr std::size_t kProbes = 128;

// A scan has at least this many times the points of a neighbourhood.
constexpr std::size_t kScanPerNeighbourhood = 8;

/// The nearest neighbours of one point. For 128 points a kd-tree would take longer than a look at
/// all.
std::vector<glm::dvec3> look_at_all(const std::vector<glm::dvec3>& positions, std::size_t from,
                                    std::uint32_t neighbours) {
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i == from) continue;
    const glm::dvec3 offset = positions[i] - positions[from];
    const double squared = glm::dot(offset, offset);
    if (nearest.size() == neighbours) {
      if (squared >= nearest.front().first) continue;
      std::ranges::pop_heap(nearest);
      nearest.pop_back();
    }
    nearest.emplace_back(squared, i);
    std::ranges::push_heap(nearest);
  }
  std::ranges::sort_heap(nearest);
  std::vector<glm::dvec3> offsets;
  offsets.reserve(nearest.size());
  for (const auto& [squared, i] : nearest) offsets.push_back(positions[i] - positions[from]);
  return offsets;
}

}  // namespace

std::uint32_t largest_scale(std::size_t points) {
  std::uint32_t largest = 0;
  for (const std::uint32_t scale : kSurfaceScales) {
    if (kScanPerNeighbourhood * scale <= points) largest = scale;
  }
  return largest;
}

Sampling sampling_of(const std::vector<glm::dvec3>& positions, const Progress& progress) {
  const std::uint32_t neighbours = largest_scale(positions.size());
  if (neighbours == 0) return {};
  std::vector<std::vector<glm::dvec3>> probes(kProbes);
  tbb::parallel_for(std::size_t{0}, kProbes, [&](std::size_t p) {
    if (progress.cancelled()) return;
    probes[p] = look_at_all(positions, p * positions.size() / kProbes, neighbours);
  });
  const auto are_many = [](std::ptrdiff_t count) {
    return static_cast<double>(count) >= kLeastInLines * kProbes;
  };
  Sampling sampling;
  if (!are_many(std::ranges::count_if(probes, lies_in_grid))) sampling.strips = Strips::Noise;
  std::ptrdiff_t in_lines = 0;
  std::ptrdiff_t coarse = 0;
  for (const std::vector<glm::dvec3>& offsets : probes) {
    const std::uint32_t scale = first_surface_scale(offsets, sampling.strips);
    if (scale > 0) ++in_lines;
    if (scale >= kCoarseScale) ++coarse;
    if (scale != kNoSurface) sampling.scale = std::max(sampling.scale, scale);
  }
  sampling.is_coarse = neighbours >= kCoarseScale && are_many(coarse);
  if (!are_many(in_lines)) sampling.scale = 0;
  return sampling;
}

}  // namespace relief

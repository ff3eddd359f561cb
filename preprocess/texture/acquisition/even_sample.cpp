#include "preprocess/texture/acquisition/even_sample.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <queue>
#include <utility>

#include "common/neighbours/radius_search.h"

namespace relief {
namespace {

struct Neighbour {
  std::uint32_t index = 0;
  float weight = 0.0F;  ///< weight of the pair
};

/// The neighbours of each candidate within `reach`.
std::vector<std::vector<Neighbour>> find_crowding(const SurfacePoints& points, double reach) {
  const RadiusSearch search(points.positions);
  std::vector<std::vector<Neighbour>> crowding(points.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, points.size(), 1024), [&](const auto& range) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          search.find(points.positions[i], reach, found);
          crowding[i].reserve(found.size());
          for (const std::uint32_t j : found) {
            if (j == i || glm::dot(points.normals[i], points.normals[j]) <= 0.0F) continue;
            const double distance = glm::distance(points.positions[i], points.positions[j]);
            const double near = std::max(0.0, 1.0 - distance / reach);
            crowding[i].push_back({j, static_cast<float>(std::pow(near, 8.0))});
          }
        }
      });
  return crowding;
}

template <class T>
std::vector<T> pick(const std::vector<T>& values, const std::vector<bool>& kept) {
  std::vector<T> picked;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (kept[i]) picked.push_back(values[i]);
  }
  return picked;
}

}  // namespace

SurfacePoints thin_out(const SurfacePoints& candidates, std::size_t count, double area) {
  assert(count > 0 && count <= candidates.size());
  // The radius of the densest packing of `count` discs; 2 r_max is the largest possible distance.
  const double r_max = std::sqrt(area / (2.0 * std::sqrt(3.0) * static_cast<double>(count)));
  const auto crowding = find_crowding(candidates, 2.0 * r_max);

  using Entry = std::pair<double, std::uint32_t>;
  std::vector<double> weights(candidates.size());
  std::vector<Entry> entries(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (const Neighbour& neighbour : crowding[i]) weights[i] += neighbour.weight;
    entries[i] = {weights[i], static_cast<std::uint32_t>(i)};
  }
  // Weights only decrease, so an outdated entry is put back when it reaches the top.
  std::priority_queue<Entry> heap(std::less<Entry>(), std::move(entries));
  std::vector<bool> kept(candidates.size(), true);
  std::size_t left = candidates.size();
  while (left > count) {
    const auto [weight, i] = heap.top();
    heap.pop();
    if (weight > weights[i]) {
      heap.emplace(weights[i], i);
      continue;
    }
    kept[i] = false;
    --left;
    for (const Neighbour& neighbour : crowding[i]) weights[neighbour.index] -= neighbour.weight;
  }
  return {pick(candidates.positions, kept), pick(candidates.normals, kept),
          pick(candidates.texcoords, kept)};
}

}  // namespace relief

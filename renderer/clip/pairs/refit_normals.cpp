#include "renderer/clip/pairs/refit_normals.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/clip/pairs/slot_pieces.h"

namespace relief {
namespace {

constexpr int kRounds = 12;
/// Normals this far apart, as vectors, have a weight of exp(-1/2).
constexpr double kSpread = 0.35;
/// Neighbours that are tested and kept, the nearest.
constexpr std::size_t kTestedForFit = 256;
constexpr std::size_t kFitted = 32;

struct FitNeighbours {
  std::vector<std::uint32_t> slots;  // kFitted for each slot
  std::vector<float> weights;        // by distance; 0 where there are fewer
};

/// Calls a function for each slot, in parallel.
template <class Function>
void for_slots(std::size_t count, const Progress& progress, const Function& function) {
  for_pieces(count, [&](std::size_t /*piece*/, std::size_t begin, std::size_t end) {
    if (progress.cancelled()) return;
    for (std::size_t slot = begin; slot < end; ++slot) function(slot);
  });
}

FitNeighbours neighbours_of(const DiscTree& tree, const Progress& progress) {
  const std::size_t count = tree.discs().size();
  FitNeighbours near{std::vector<std::uint32_t>(count * kFitted, 0),
                     std::vector<float>(count * kFitted, 0.0F)};
  for_slots(count, progress, [&](std::size_t slot) {
    std::vector<std::uint32_t> found;
    tree.neighbours(slot, kTestedForFit, found);
    const Disc& self = tree.discs()[slot];
    std::vector<std::pair<double, std::uint32_t>> by_distance;
    for (const std::uint32_t other : found) {
      const Disc& disc = tree.discs()[other];
      const double share = glm::distance(self.centre, disc.centre) / (self.radius + disc.radius);
      by_distance.emplace_back(share, other);
    }
    std::sort(by_distance.begin(), by_distance.end());
    for (std::size_t k = 0; k < std::min(by_distance.size(), kFitted); ++k) {
      const double closeness = 1.0 - by_distance[k].first;
      near.slots[slot * kFitted + k] = by_distance[k].second;
      near.weights[slot * kFitted + k] = static_cast<float>(closeness);
    }
  });
  return near;
}

}  // namespace

Result<std::vector<glm::dvec3>> refit_normals(const DiscTree& tree, Progress& progress) {
  const std::size_t count = tree.discs().size();
  const FitNeighbours near = neighbours_of(tree, progress);
  std::vector<glm::dvec3> normals(count);
  for (std::size_t slot = 0; slot < count; ++slot) normals[slot] = tree.discs()[slot].normal;
  std::vector<glm::dvec3> next(count);
  for (int round = 0; round < kRounds; ++round) {
    for_slots(count, progress, [&](std::size_t slot) {
      glm::dvec3 sum = normals[slot];
      for (std::size_t k = slot * kFitted; k < (slot + 1) * kFitted; ++k) {
        if (near.weights[k] == 0.0F) break;
        const glm::dvec3 other = normals[near.slots[k]];
        const glm::dvec3 apart = other - normals[slot];
        const double alike = std::exp(-0.5 * glm::dot(apart, apart) / (kSpread * kSpread));
        sum += double{near.weights[k]} * alike * other;
      }
      const double length = glm::length(sum);
      next[slot] = length > 0.0 ? sum / length : normals[slot];
    });
    std::swap(normals, next);
    if (progress.cancelled()) return interrupted_error();
  }
  return normals;
}

}  // namespace relief

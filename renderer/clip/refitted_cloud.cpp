#include "renderer/clip/refitted_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <iterator>
#include <vector>

#include "renderer/clip/pairs/disc_tree.h"
#include "renderer/clip/pairs/refit_normals.h"
#include "renderer/clip/pairs/slot_pieces.h"

namespace relief {
namespace {

/// The neighbourhood that normals are fitted in is that of the discs of `ewa` at its default
/// cutoff, whatever engine draws them: sqrt(2) of the points' radii.
SplatDiscs fitting_discs(const SplatCloud& cloud) {
  SplatDiscs discs;
  discs.centres = cloud.positions;
  discs.normals.assign(cloud.normals.begin(), cloud.normals.end());
  discs.radii.reserve(cloud.radii.size());
  std::transform(cloud.radii.begin(), cloud.radii.end(), std::back_inserter(discs.radii),
                 [](double radius) { return std::sqrt(2.0) * radius; });
  return discs;
}

/// Discs whose normals part by more than this are on both sides of an edge: 30 degrees, the least
/// of the thresholds that are found from noise (pairs/different_surface.cpp).
constexpr double kEdgeCosine = 0.866;
/// Discs that are looked at for an edge.
constexpr std::size_t kLookedAt = 256;

/// Which discs have an edge in reach. Elsewhere a normal stays what it is: means over neighbours
/// would only flatten what is bent.
std::vector<std::uint8_t> find_near_edges(const DiscTree& tree,
                                          const std::vector<glm::dvec3>& normals) {
  std::vector<std::uint8_t> near(normals.size(), 0);
  for_pieces(near.size(), [&](std::size_t /*piece*/, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> found;
    for (std::size_t slot = begin; slot < end; ++slot) {
      found.clear();
      tree.neighbours(slot, kLookedAt, found);
      const bool is_near = std::any_of(found.begin(), found.end(), [&](std::uint32_t other) {
        return glm::dot(normals[slot], normals[other]) < kEdgeCosine;
      });
      near[slot] = is_near ? 1 : 0;
    }
  });
  return near;
}

}  // namespace

Result<const SplatCloud*> RefittedCloud::get(const ClipSettings& settings, Progress& progress) {
  if (!refits_normals(settings)) return &given_;
  if (!refitted_) {
    progress.begin_stage("normals at edges", 0);
    const DiscTree tree(fitting_discs(given_));
    RELIEF_TRY_ASSIGN(const std::vector<glm::dvec3> normals, refit_normals(tree, progress));
    const std::vector<std::uint8_t> near_edges = find_near_edges(tree, normals);
    refitted_ = given_;
    for (std::size_t slot = 0; slot < normals.size(); ++slot)
      if (near_edges[slot] != 0)
        refitted_->normals[tree.discs()[slot].splat] = glm::vec3(normals[slot]);
  }
  return &*refitted_;
}

}  // namespace relief

#include "renderer/clip/refitted_cloud.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "renderer/clip/disc_tree.h"
#include "renderer/clip/refit_normals.h"

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

}  // namespace

Result<const SplatCloud*> RefittedCloud::get(const ClipSettings& settings, Progress& progress) {
  if (!refits_normals(settings)) return &given_;
  if (!refitted_) {
    progress.begin_stage("normals at edges", 0);
    const DiscTree tree(fitting_discs(given_));
    RELIEF_TRY_ASSIGN(const std::vector<glm::dvec3> normals, refit_normals(tree, progress));
    refitted_ = given_;
    for (std::size_t slot = 0; slot < normals.size(); ++slot)
      refitted_->normals[tree.discs()[slot].splat] = glm::vec3(normals[slot]);
  }
  return &*refitted_;
}

}  // namespace relief

// What clips a cloud of splats, kept from image to image.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/clip_partners.h"
#include "renderer/engines/ewa/splatting.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/settings.h"

namespace relief::ewa {

/// The discs that splats are: kernels end at sqrt(2 cutoff) radii in their tangent planes.
[[nodiscard]] SplatDiscs discs_of(const SplatCloud& cloud, double cutoff);

/// Finds the clip partners of clouds when images need them, and keeps those of the last settings.
class ClipCache {
 public:
  /// `body_ends`: of the finest cloud, as find_clip_partners_of_bodies() has them.
  explicit ClipCache(std::vector<std::size_t> body_ends) : body_ends_(std::move(body_ends)) {}

  /// What the settings clip of a level of a hierarchy (0: the cloud itself), whose splats are
  /// classified anew, bodies together: clusters are of several. Lives until the level is asked for
  /// with other settings, or is another cloud. `cloud` has the normals that the settings ask for
  /// (RefittedCloud). Fails only if it is interrupted.
  Result<Clipping> get(const SplatCloud& cloud, std::size_t level, const RenderSettings& settings,
                       Progress& progress);

 private:
  struct Found {
    const SplatCloud* cloud = nullptr;
    ClipSettings settings;
    double cutoff = 0.0;
    ClipPartners partners;
  };
  std::vector<std::size_t> body_ends_;
  std::map<std::size_t, Found> found_;  ///< by level
};

}  // namespace relief::ewa

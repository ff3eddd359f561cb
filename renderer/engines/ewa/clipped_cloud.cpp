#include "renderer/engines/ewa/clipped_cloud.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "renderer/clip/bodies.h"
#include "renderer/clip/refitted_cloud.h"

namespace relief::ewa {

SplatDiscs discs_of(const SplatCloud& cloud, double cutoff) {
  SplatDiscs discs;
  discs.centres = cloud.positions;
  discs.normals.assign(cloud.normals.begin(), cloud.normals.end());
  const double reach = std::sqrt(2.0 * cutoff);
  discs.radii.reserve(cloud.radii.size());
  std::transform(cloud.radii.begin(), cloud.radii.end(), std::back_inserter(discs.radii),
                 [reach](double radius) { return reach * radius; });
  return discs;
}

Result<Clipping> ClipCache::get(const SplatCloud& cloud, std::size_t level,
                                const RenderSettings& settings, Progress& progress) {
  if (settings.clip.rule == ClipRule::Off) return Clipping{};
  const double cutoff = settings.ewa.cutoff;
  auto found = found_.find(level);
  if (found == found_.end() || found->second.settings != settings.clip ||
      found->second.cutoff != cutoff || found->second.cloud != &cloud) {
    const std::span<const std::size_t> bodies =
        level == 0 ? std::span<const std::size_t>(body_ends_) : std::span<const std::size_t>();
    RELIEF_TRY_ASSIGN(ClipPartners partners,
                      find_clip_partners_of_bodies(discs_of(cloud, cutoff), bodies,
                                                   classified_as(settings.clip), progress));
    found =
        found_.insert_or_assign(level, Found{&cloud, settings.clip, cutoff, std::move(partners)})
            .first;
  }
  return Clipping{&found->second.partners, settings.clip.rule};
}

}  // namespace relief::ewa

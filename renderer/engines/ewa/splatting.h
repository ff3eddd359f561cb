// Splats a cloud of points into an image ([Zwicker 2001], section 4), in parallel over tiles.
#pragma once

#include <cstdint>

#include "common/progress.h"
#include "renderer/clip/clip_partners.h"
#include "renderer/engines/ewa/deferred_shading.h"
#include "renderer/engines/ewa/settings.h"
#include "renderer/frame/targets/film.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/view/view.h"

namespace relief::ewa {

/// What clips the splats of a cloud: nothing without partners.
struct Clipping {
  const ClipPartners* partners = nullptr;
  ClipRule rule = ClipRule::Off;
};

struct Splatted {
  Film film;
  std::uint64_t evaluations = 0;  ///< kernel values above the cutoff: contributions to pixels
};

/// Draws all points. Each tile takes its points in the cloud's order, so that the film does not
/// depend on the number of threads. Stops early, with an unfinished film, if `progress` is
/// cancelled. Each contribution is weighted by the share that the pixel keeps of the splat
/// (clip_lines.h).
[[nodiscard]] Splatted splat_cloud(const SplatCloud& cloud, const View& view,
                                   const EwaSettings& settings, const Lighting& lighting,
                                   const Progress& progress, const Clipping& clipping = {});

}  // namespace relief::ewa

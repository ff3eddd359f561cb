// Splats whose planes follow the sides of sharp edges.
#pragma once

#include <optional>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/settings.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Whether splats are drawn, and classified, with normals that are fitted anew.
[[nodiscard]] inline bool refits_normals(const ClipSettings& settings) {
  return settings.rule != ClipRule::Off && settings.normals == ClipNormals::Refit;
}

/// A cloud with normals as ClipNormals asks for. The normals of points on an edge are means of both
/// sides: splats that lean over the edge hang over whatever clips them, so that they are turned to
/// the side that they are nearer to, not only classified so.
class RefittedCloud {
 public:
  /// `given` outlives it.
  explicit RefittedCloud(const SplatCloud& given) : given_(given) {}

  /// The given cloud, or one with refitted normals, which is made once. What clips it is found with
  /// classified_as() of the settings. Fails only if it is interrupted.
  Result<const SplatCloud*> get(const ClipSettings& settings, Progress& progress);

 private:
  const SplatCloud& given_;
  std::optional<SplatCloud> refitted_;
};

/// The settings that classify a cloud whose normals have been refitted where they ask for it.
[[nodiscard]] inline ClipSettings classified_as(ClipSettings settings) {
  settings.normals = ClipNormals::Given;
  return settings;
}

}  // namespace relief

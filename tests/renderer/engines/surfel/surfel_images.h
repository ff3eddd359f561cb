// Images of the engine `surfel`, for its tests.
#pragma once

#include "tests/renderer/engines/ewa/ewa_clouds.h"
#include "tests/renderer/images.h"

namespace relief::test {

/// A square image with all outputs, unlit, transparent where nothing is, seen from `eye` toward
/// the origin. Surfels are as large as the cloud says.
inline RenderSettings surfel_image(glm::dvec3 eye, std::uint32_t side = 96) {
  RenderSettings settings = ewa_image(eye, side);
  settings.engine = "surfel";
  settings.surfel.size = SurfelSize::Given;
  settings.frames = 0;
  settings.debug = true;
  return settings;
}

inline RenderResult must_draw(const RenderModel& model, const RenderSettings& settings) {
  Progress silent;
  auto result = render(model, settings, silent);
  if (result) return *result;
  ADD_FAILURE() << result.error().message;
  return {};
}

inline RenderResult must_draw(const SplatCloud& cloud, const RenderSettings& settings) {
  return must_draw(RenderModel::of(cloud), settings);
}

/// Whether two images have the same channels with the same values.
inline bool is_same(const Image& a, const Image& b) {
  if (a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    if (a.channels[c].name != b.channels[c].name || a.channels[c].values != b.channels[c].values)
      return false;
  }
  return true;
}

}  // namespace relief::test

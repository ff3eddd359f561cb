// Volumes and scenes of 3D Gaussians that are drawn in one image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "common/volume/gaussian_cloud.h"
#include "common/volume/scalar_volume.h"

namespace relief {

/// One of them, where it stands in the world.
struct VolumePart {
  std::variant<ScalarVolume, GaussianCloud> what;
  std::uint8_t material = 0;  ///< index into a scene's materials
  std::size_t settings = 0;   ///< index into RenderSettings::volumes
};

struct VolumeParts {
  std::vector<VolumePart> list;  ///< not empty
};

}  // namespace relief

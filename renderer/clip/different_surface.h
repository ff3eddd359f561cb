// When the normals of two splats are of different surfaces.
#pragma once

#include "renderer/clip/disc_tree.h"
#include "renderer/clip/partners.h"
#include "renderer/clip/settings.h"

namespace relief {

/// The test with the threshold of the settings, or with one from the noise of the normals.
[[nodiscard]] SurfaceTest surface_test(const DiscTree& tree, const ClipSettings& settings);

}  // namespace relief

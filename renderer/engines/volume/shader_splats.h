// Footprints as shaders take them.
#pragma once

#include <span>
#include <vector>

#include "renderer/engines/volume/drawing.h"
#include "renderer/volume/splats/splat_order.h"
#include "shaders/volume/layout.h"

namespace relief::volume {

[[nodiscard]] std::vector<shared::VolumeSplat> shader_splats(const VolumeFrame& frame,
                                                             std::span<const PlacedSplat> placed);

/// Fails if that many are more than a table of this OpenGL holds.
Result<Table> make_splat_table(const Gl& gl, std::span<const shared::VolumeSplat> splats);

}  // namespace relief::volume

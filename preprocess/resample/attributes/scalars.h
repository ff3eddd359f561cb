// Maps of a patch's scalars on its base plane.
#pragma once

#include "common/patch.h"
#include "preprocess/resample/heights/mls.h"
#include "preprocess/resample/support/support.h"

namespace relief {

/// Returns the codes of a scalar, `scale` texels per grid cell. Numbers are interpolated between
/// the points as colours are (sample_colours); labels are those of the nearest point. A texel whose
/// nearest point has no value gets none. `scalar` has a value for each point of the scan.
[[nodiscard]] AttributeMap<std::uint16_t> sample_scalar(
    const PatchPoints& points, const PointGrid& lookup, const std::vector<NodeState>& states,
    const PatchGrid& grid, const PointScalar& scalar, const ScalarInfo& info, std::uint32_t scale);

/// Describes all scalars; drops those without a finite value.
[[nodiscard]] std::vector<ScalarInfo> describe_scalars(std::vector<PointScalar>& scalars);

}  // namespace relief

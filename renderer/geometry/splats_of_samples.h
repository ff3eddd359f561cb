// The samples of patches as points for the engines that draw points.
#pragma once

#include "common/patch.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// One point per sample: position, the normal (the mean over a cell of a map with several texels a
/// cell) and colour that the patch's maps have at its node, its grid coordinates and its patch.
///
/// The samples' spacing is fixed on the base plane; on a surface that leans by an angle t the
/// grid's cells are 1 / cos t times as large, and h is the side of a square of that area: spacing /
/// sqrt(cos t), the geometric mean of the spacings across and along the slope. Samples of a margin
/// lie where the next patch has samples too, and are points like all others: Eq. (9) divides by
/// what the kernels sum up to, and coverage is capped.
[[nodiscard]] SplatCloud splats_of_samples(const PatchModel& model);

}  // namespace relief

// The texture of a mesh or of points, on splats.
#pragma once

#include "common/points.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Gives the splats of some points (splats_of_points, in the same order) their texture and texture
/// coordinates. A point has the material and the coordinates of the first triangle with a material
/// that has it; of points without triangles all have the one material and their own coordinates.
///
/// The texture is the one that most points have, times its material's colour. Points of other
/// materials, or of none, have no coordinates (NaN): their colours stand. Those of all points with
/// a material become its colour there, for engines that draw no textures. Does nothing without
/// materials.
void texture_splats(const Points& points, SplatCloud& cloud);

}  // namespace relief

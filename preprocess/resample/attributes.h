// Computes the attribute maps of a patch: normals and colours on its base plane.
#pragma once

#include "common/patch.h"
#include "preprocess/resample/mls.h"
#include "preprocess/resample/support.h"

namespace relief {

/// Sets one normal per grid node: the fitted surface's, or the mean of the points' normals. Holes
/// continue their surroundings.
[[nodiscard]] AttributeMap<glm::i16vec2> sample_normals(const std::vector<SurfacePoint>& surface,
                                                        const std::vector<NodeState>& states,
                                                        const PatchGrid& grid, bool from_points);

/// Sets a colour map of `scale` texels per grid cell. Colours are interpolated between the points
/// (ColourInterpolation); where the scan is finer than the texels, they are means of nearby points.
/// Both in linear light. `colours` has one colour for each point of the scan.
[[nodiscard]] AttributeMap<glm::u8vec3> sample_colours(
    const PatchPoints& points, const PointGrid& lookup, const std::vector<NodeState>& states,
    const PatchGrid& grid, const std::vector<glm::u8vec3>& colours, std::uint32_t scale);

}  // namespace relief

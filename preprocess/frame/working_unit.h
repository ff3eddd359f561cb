// The unit that a conversion computes in, so that its result does not depend on the scan's.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/convert_options.h"

namespace relief {

/// Returns the largest power of two that is not above a length; 1 without a finite length.
[[nodiscard]] double power_of_two_below(double length);

/// Returns the power of two, in world units, that is about half as wide as a scan: the median
/// distance of its points from their middle, so that stray points far away do not count. 1 if the
/// scan has no extent. In this unit squares and fourth powers of lengths fit into single precision,
/// and dividing by it is exact.
[[nodiscard]] double working_unit(const std::vector<glm::dvec3>& positions);

/// Returns the unit of a scan or a mesh. That of a coarse mesh (is_coarse_mesh) is half as wide as
/// its triangles reach, because most of its points may lie in one place.
[[nodiscard]] double working_unit_of(const Points& points);

/// Returns the points of a scan that are at most two of its median distances from their middle.
[[nodiscard]] std::vector<glm::dvec3> points_in_the_middle(
    const std::vector<glm::dvec3>& positions);

/// Converts a scan from world units to working ones.
void to_working_unit(Points& points, double unit);

/// Returns the options with lengths and positions in working units.
[[nodiscard]] ConvertOptions to_working_unit(ConvertOptions options, double unit);

// From working units to world ones.

void to_world_unit(std::vector<Patch>& patches, double unit);
void to_world_unit(ConvertResult& result, double unit);

}  // namespace relief

// Points that lie off every surface.
#pragma once

#include <cstdint>
#include <vector>

#include "common/neighbours/neighbours.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// Marks, with 1, points that are no part of a surface, by what their neighbours show. Either
/// - they are off their neighbours' plane by more than two of their spacings and four times the
///   neighbours' own distance to it (rms), or
/// - they are off it by half a spacing, and twice as far from their neighbours as these are from
///   theirs, or
/// - their neighbours fill a ball, 4 times as far apart as the scan's points usually are.
///
/// So single points off a surface and clouds of them are stray, whether or not the rest of the scan
/// has noise. Points where a scan is thin, sharp or sparse are not. The graph has
/// kSurfaceNeighbours neighbours. Points beside clouds show only once those are gone.
[[nodiscard]] std::vector<std::uint8_t> find_stray_points(const std::vector<glm::dvec3>& positions,
                                                          const NeighbourGraph& graph);

/// Drops stray points, and those that show once these are gone, unless most are stray, which then
/// are the scan. The graph follows. Returns for each point, as they were, 1 if it was dropped.
std::vector<std::uint8_t> drop_stray_points(Points& points, NeighbourGraph& graph,
                                            const Progress& progress);

}  // namespace relief

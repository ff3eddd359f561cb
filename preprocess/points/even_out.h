// Scans whose points lie far denser along lines than across them.
#pragma once

#include <cstdint>

#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// Merges points of bare scans that lie in lines: along the lines of a scanner whose lines are far
/// apart (from about 1 : 4 on), and along the rays of one that measured every ray many times. There
/// the nearest neighbours, which every later stage looks at, are no surface (first_surface_scale).
///
/// Nothing is done unless an eighth of the scan is so (sampling_of). Then each point in file order
/// takes those that lie nearer than points would if 16 of them filled the neighbourhood that shows
/// a surface. Where that takes very many, the nearest are merged first, in up to four rounds. The
/// merged point has the mean of their positions, normals and colours (in linear light), and
/// otherwise what the first has. Points whose given normals oppose each other stay apart.
///
/// Returns how many points were merged into others. The result does not depend on threads. The
/// points stay as they are if too few for a surface would be left. Incomplete if the user
/// interrupts.
std::uint64_t even_out(Points& points, Progress& progress);

}  // namespace relief

// What of a scan is dust: `relief convert --clean`.
#pragma once

#include <cstdint>

#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// How many points were taken away, and why.
struct OutlierReport {
  std::uint64_t sparse = 0;    ///< farther from their neighbours than the scan or these are
  std::uint64_t cluster = 0;   ///< in clusters too small to be a surface
  bool were_too_many = false;  ///< more than half would have gone, so none was taken away
};

/// Takes away points that are no part of a surface, and the triangles at them.
///
/// Sparse is a point whose mean distance to its 16 nearest neighbours is far above that of the
/// whole scan (5 standard deviations of its logarithm, found from the median and the median
/// deviation) or more than 3 times the median of those neighbours' own. Of what is left, points are
/// linked that are neighbours within 4 local spacings; clusters of fewer than 50 go. The result
/// does not depend on the number of threads. Scans of fewer than kLeastSurfacePoints points stay as
/// they are, and so do those of which more than half would go.
OutlierReport remove_outliers(Points& points, Progress& progress);

}  // namespace relief

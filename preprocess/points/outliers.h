// Removes outliers: `relief convert --clean`.
#pragma once

#include <cstdint>

#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// The number of removed points, by reason.
struct OutlierReport {
  std::uint64_t sparse = 0;    ///< unusually far from their neighbours
  std::uint64_t cluster = 0;   ///< in clusters too small to be a surface
  bool were_too_many = false;  ///< more than half would have been removed, so none were
};

/// Removes points that are not part of a surface, and their triangles.
///
/// A point is sparse if its mean distance to its 16 nearest neighbours is far above the scan's (5
/// standard deviations of the logarithm, estimated from the median and the median deviation) or
/// more than 3 times the median of those neighbours' own. The remaining points are linked if they
/// are neighbours within 4 local spacings; clusters of fewer than 50 points are removed. The result
/// does not depend on the number of threads. Scans of fewer than kMinSurfacePoints points, and
/// scans that would lose more than half of their points, stay unchanged.
OutlierReport remove_outliers(Points& points, Progress& progress);

}  // namespace relief

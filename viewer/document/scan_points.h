// The points of a scan, or the samples of patches, as they are shown until the surface is there.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// Of larger scans every so many points are shown: they wait for a picture a tenth of a second, not
/// ten.
inline constexpr std::size_t kMostShownPoints = 2'000'000;

/// Of patches: their surface follows in a second or two, and without a GPU a picture of 470,000
/// points takes a third of one.
inline constexpr std::size_t kMostShownSamples = 150'000;

/// A point as OpenGL reads it.
struct ShownPoint {
  glm::vec3 position;  ///< from `origin`, world units
  glm::u8vec4 colour;  ///< sRGB; w: 255
};

struct ScanPoints {
  glm::dvec3 origin{0.0};
  std::vector<ShownPoint>
      points;             ///< in an order in which any first part of them is spread over all
  std::size_t total = 0;  ///< points of the scan, of which some are in `points`
  bool is_lit = false;    ///< their colours show their shape
  double spacing = 0.0;   ///< about how far apart neighbours are, world units
  PatchModel extent;      ///< bounds, extreme points and stance, without patches
};

/// Takes the finite points of a scan. Points without colours are grey, lit from above by their
/// normals if they have some.
[[nodiscard]] ScanPoints scan_points_of(const Points& points);

/// Takes samples of patches, kMostShownSamples at most, coloured or lit in the same way.
[[nodiscard]] ScanPoints scan_points_of(const PatchModel& model);

}  // namespace relief

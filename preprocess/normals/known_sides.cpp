#include "preprocess/normals/known_sides.h"

#include <glm/geometric.hpp>

#include "preprocess/normals/sampled_sides.h"

namespace relief {
namespace {

// An open sheet that hardly bends, such as a terrain, has no outside: +Z decides. Half a sphere
// sees 0.29 of itself about each of its points (mean) and has a mean normal of 0.5: with this
// weight, its outside counts four times as much as +Z.
constexpr float kUpWeight = 0.15F;
// No more than an eighth of the largest error that a wrong side can be: a surface that bends under
// an overhang keeps its sides even if the guess that the scan is airborne is wrong.
constexpr float kAirborneWeight = 0.5F;
// Sheets that the winding numbers of a part don't decide face as in the whole scan. Half of the
// largest error that a wrong side can be: a sample errs in thin parts, which the points themselves
// tell. scripts/large_scan.py with three bodies, samples of 10,000 and 47,000 points, of the bodies
// from above 5.2 and 2.7 % face down with 1 and without what lies around the part, 2.1 % of the
// latter with 0.5: their silhouettes. With 0 the ground of a tile is turned over.
constexpr float kWholeWeight = 0.5F;
// So that the side of a flat sheet is not left to rounding.
constexpr float kLeastWeight = 1e-3F;

KnownSides led_by(const SampledSides& whole) {
  return {.whole = &whole, .weight = kWholeWeight, .leads_slivers = true};
}

}  // namespace

glm::vec3 KnownSides::direction_at(const Points& points, std::size_t point) const {
  if (whole != nullptr) return whole->normal_near(points.positions[point]);
  if (!viewpoint && !is_of_scanners) return up;
  const glm::dvec3 from = is_of_scanners ? points.scanners[points.scanner_of[point]] : *viewpoint;
  const glm::dvec3 to = from - points.positions[point];
  const double length = glm::length(to);
  return length > 0.0 ? glm::vec3(to / length) : glm::vec3(0.0F);
}

KnownSides known_sides(const Points& points, const SideChoice& choice) {
  const glm::vec3 up(choice.up);
  switch (choice.side) {
    case NormalSide::Up:
      return {.up = up, .weight = 1.0F, .is_sure = true};
    case NormalSide::Toward:
      return {.viewpoint = choice.toward, .weight = 1.0F, .is_sure = true};
    case NormalSide::Outward:
      return choice.whole != nullptr ? led_by(*choice.whole)
                                     : KnownSides{.up = up, .weight = kLeastWeight};
    case NormalSide::Auto:
      break;
  }
  if (points.viewpoint || !points.scanner_of.empty()) {
    return {.viewpoint = points.viewpoint,
            .is_of_scanners = !points.scanner_of.empty(),
            .weight = 1.0F,
            .is_sure = true};
  }
  if (choice.whole != nullptr) return led_by(*choice.whole);
  return {.up = up,
          .weight = points.is_airborne ? kAirborneWeight : kUpWeight,
          .leads_slivers = points.is_airborne};
}

}  // namespace relief

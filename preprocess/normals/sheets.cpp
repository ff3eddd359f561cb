#include "preprocess/normals/sheets.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

// Normals of a closed surface cancel out. With no more than this share of its area left, and with
// this much flux over area to the power of 1.5 (half a sphere has 0.3), a sheet encloses something.
constexpr double kClosedShare = 0.1;
constexpr double kClosedFlux = 0.02;

}  // namespace

void SheetSums::add(const SheetSums& other, bool turned) {
  const double sign = turned ? -1.0 : 1.0;
  points += other.points;
  area += other.area;
  moment += other.moment;
  area_normal += sign * other.area_normal;
  flux += sign * other.flux;
  kept_area += sign * other.kept_area;
}

std::vector<SheetSums> sum_up(const Points& points, std::size_t count,
                              std::span<const glm::vec3> normals, std::span<const float> spacing,
                              const Sheets& sheets, const glm::dvec3& base) {
  std::vector<SheetSums> sums(sheets.count);
  for (std::size_t i = 0; i < count; ++i) {
    const double area = double{spacing[i]} * spacing[i];
    const glm::dvec3 position = points.positions[i] - base;
    const glm::dvec3 area_normal = area * glm::dvec3(normals[i]);
    SheetSums& sum = sums[sheets.of_point[i]];
    sum.points += 1.0;
    sum.area += area;
    sum.kept_area += area;
    sum.moment += area * position;
    sum.area_normal += area_normal;
    sum.flux += glm::dot(area_normal, position);
  }
  return sums;
}

bool faces_inward(const SheetSums& sheet) {
  if (!(sheet.area > 0.0)) return false;
  const double flux = sheet.flux - glm::dot(sheet.area_normal, sheet.moment / sheet.area);
  const bool is_closed = glm::length(sheet.area_normal) < kClosedShare * sheet.area &&
                         std::abs(flux) > kClosedFlux * sheet.area * std::sqrt(sheet.area);
  return is_closed ? flux < 0.0 : sheet.kept_area < 0.0;
}

}  // namespace relief

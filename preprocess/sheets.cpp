#include "preprocess/sheets.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace relief {

void SheetSums::add(const SheetSums& other, bool turned) {
  const double sign = turned ? -1.0 : 1.0;
  area += other.area;
  moment += other.moment;
  area_normal += sign * other.area_normal;
  flux += sign * other.flux;
  to_viewpoint += sign * other.to_viewpoint;
}

std::vector<SheetSums> sum_up(const Points& points, std::size_t count,
                              std::span<const glm::vec3> normals, std::span<const float> spacing,
                              const Sheets& sheets, const glm::dvec3& base) {
  std::vector<SheetSums> sums(sheets.count);
  for (std::size_t i = 0; i < count; ++i) {
    const double area = double{spacing[i]} * spacing[i];
    const glm::dvec3 place = points.positions[i] - base;
    const glm::dvec3 area_normal = area * glm::dvec3(normals[i]);
    SheetSums& sum = sums[sheets.of_point[i]];
    sum.area += area;
    sum.moment += area * place;
    sum.area_normal += area_normal;
    sum.flux += glm::dot(area_normal, place);
    if (points.viewpoint) {
      sum.to_viewpoint +=
          glm::dot(area_normal, glm::normalize(*points.viewpoint - points.positions[i]));
    }
  }
  return sums;
}

bool faces_inward(const SheetSums& sheet, bool has_viewpoint) {
  if (!(sheet.area > 0.0)) return false;
  const double flux = has_viewpoint
                          ? sheet.to_viewpoint
                          : sheet.flux - glm::dot(sheet.area_normal, sheet.moment / sheet.area);
  // A flat sheet has no outside; there +Z decides so that the result is at least predictable.
  const double scale = sheet.area * std::sqrt(sheet.area);
  if (std::abs(flux) > 1e-3 * scale) return flux < 0.0;
  const glm::dvec3 n = sheet.area_normal;
  return n.z + 1e-3 * n.y + 1e-6 * n.x < 0.0;
}

}  // namespace relief

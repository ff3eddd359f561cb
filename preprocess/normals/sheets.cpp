#include "preprocess/normals/sheets.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

// Share of a sheet's area in the sum of its normals above which it is open and faces one way; flux
// over area to the power of 1.5 at which the flux of such a sheet, and of any other, decides its
// outside.
constexpr double kOpenShare = 0.5;
constexpr double kBentFlux = 0.05;
constexpr double kMinFlux = 1e-3;

}  // namespace

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
    const glm::dvec3 position = points.positions[i] - base;
    const glm::dvec3 area_normal = area * glm::dvec3(normals[i]);
    SheetSums& sum = sums[sheets.of_point[i]];
    sum.area += area;
    sum.moment += area * position;
    sum.area_normal += area_normal;
    sum.flux += glm::dot(area_normal, position);
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
  // An open sheet that hardly bends, such as a terrain, has no outside: +Z decides. (Normals of a
  // closed surface cancel out; half a sphere has half its area and 0.3 of its scale.)
  const glm::dvec3 n = sheet.area_normal;
  const double scale = sheet.area * std::sqrt(sheet.area);
  const bool is_open = glm::length(n) > kOpenShare * sheet.area;
  if (std::abs(flux) > (is_open ? kBentFlux : kMinFlux) * scale) return flux < 0.0;
  return n.z + 1e-3 * n.y + 1e-6 * n.x < 0.0;
}

}  // namespace relief

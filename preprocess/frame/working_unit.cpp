#include "preprocess/frame/working_unit.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "common/bounds.h"
#include "common/median.h"
#include "common/mesh/coarse_mesh.h"
#include "common/scalar.h"

namespace relief {

namespace {

// So many points tell the size of any scan well enough.
constexpr std::size_t kEnoughPoints = 1000;

/// Where half of a scan's points are.
struct Middle {
  glm::dvec3 centre{0.0};
  double distance = 0.0;  ///< the median one, as `distance_from` measures it
};

/// Not the length, whose squares would overflow.
double distance_from(glm::dvec3 centre, glm::dvec3 p) {
  const glm::dvec3 d = glm::abs(p - centre);
  return std::max({d.x, d.y, d.z});
}

/// There is at least one position.
Middle middle_of(const std::vector<glm::dvec3>& positions) {
  const std::size_t step = (positions.size() + kEnoughPoints - 1) / kEnoughPoints;
  Middle middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < positions.size(); i += step) values.push_back(positions[i][axis]);
    middle.centre[axis] = median_of(std::move(values));
  }
  std::vector<double> distances;
  for (std::size_t i = 0; i < positions.size(); i += step)
    distances.push_back(distance_from(middle.centre, positions[i]));
  middle.distance = median_of(std::move(distances));
  return middle;
}

}  // namespace

double power_of_two_below(double length) {
  return length > 0.0 && std::isfinite(length) ? std::ldexp(1.0, std::ilogb(length)) : 1.0;
}

double working_unit(const std::vector<glm::dvec3>& positions) {
  return positions.empty() ? 1.0 : power_of_two_below(middle_of(positions).distance);
}

double working_unit_of(const Points& points) {
  if (!is_coarse_mesh(points)) return working_unit(points.positions);
  std::vector<glm::dvec3> corners;
  corners.reserve(3 * points.triangles.size());
  for (const Triangle& t : points.triangles) {
    for (const std::uint32_t corner : t) corners.push_back(points.positions[corner]);
  }
  const Bounds bounds = bounds_of(corners);
  return power_of_two_below(distance_from(bounds.min, bounds.max) / 2.0);
}

std::vector<glm::dvec3> points_in_the_middle(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return {};
  const Middle middle = middle_of(positions);
  std::vector<glm::dvec3> near;
  for (const glm::dvec3& p : positions) {
    if (distance_from(middle.centre, p) <= 2.0 * middle.distance) near.push_back(p);
  }
  return near;
}

void to_working_unit(Points& points, double unit) {
  for (glm::dvec3& p : points.positions) p /= unit;
  if (points.viewpoint) *points.viewpoint /= unit;
  for (glm::dvec3& scanner : points.scanners) scanner /= unit;
}

ConvertOptions to_working_unit(ConvertOptions options, double unit) {
  options.spacing /= unit;
  options.error /= unit;
  options.noise /= unit;
  options.height_step /= unit;
  options.side.toward /= unit;
  return options;
}

void to_world_unit(std::vector<Patch>& patches, double unit) {
  for (Patch& patch : patches) {
    patch.origin *= unit;
    patch.spacing *= unit;
    patch.height_step *= unit;
  }
}

void to_world_unit(ConvertResult& result, double unit) {
  PatchModel& model = result.model;
  to_world_unit(model.patches, unit);
  model.spacing *= unit;
  model.bounds.min *= unit;
  model.bounds.max *= unit;
  model.bounding_radius *= unit;
  for (glm::dvec3& p : model.extremes) p *= unit;
  for (ScalarInfo& scalar : model.scalars) {
    if (scalar.name != kDistanceScalar) continue;
    scalar.offset *= unit;
    scalar.step *= unit;
  }
  ConvertReport& report = result.report;
  for (double* length : {&report.noise, &report.error_rms, &report.error_max,
                         &report.finest_spacing, &report.coarsest_spacing})
    *length *= unit;
}

}  // namespace relief

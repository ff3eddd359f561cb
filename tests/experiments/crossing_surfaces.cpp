#include "tests/experiments/crossing_surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "common/bounds.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/points/point_radii.h"
#include "renderer/geometry/meshes/mesh_of_points.h"

namespace relief::experiment {
namespace {

constexpr glm::vec3 kOrange(0.9F, 0.35F, 0.05F);
constexpr glm::vec3 kBlue(0.05F, 0.3F, 0.9F);

void append(Surfaces& to, const TriangleMesh& mesh, const std::vector<double>& radii,
            glm::vec4 colour) {
  const auto first = static_cast<std::uint32_t>(to.mesh.positions.size());
  to.mesh.positions.insert(to.mesh.positions.end(), mesh.positions.begin(), mesh.positions.end());
  to.mesh.normals.insert(to.mesh.normals.end(), mesh.normals.begin(), mesh.normals.end());
  to.mesh.colours.insert(to.mesh.colours.end(), mesh.positions.size(), colour);
  for (const Triangle& t : mesh.triangles)
    to.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  to.cloud.positions = to.mesh.positions;
  to.cloud.normals = to.mesh.normals;
  to.cloud.colours = to.mesh.colours;
  to.cloud.radii.insert(to.cloud.radii.end(), radii.begin(), radii.end());
}

/// A place of a sheet; s and t from -1 to 1.
using Sheet = std::function<glm::dvec3(double s, double t)>;

void append_sheet(Surfaces& to, const Sheet& sheet, std::uint32_t side, glm::vec4 colour) {
  constexpr double kStep = 1e-4;  // of the derivatives
  TriangleMesh mesh;
  std::vector<double> radii;
  const double cell = 2.0 / (side - 1);
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      const double s = i * cell - 1.0;
      const double t = j * cell - 1.0;
      const glm::dvec3 along_s = (sheet(s + kStep, t) - sheet(s - kStep, t)) / (2.0 * kStep);
      const glm::dvec3 along_t = (sheet(s, t + kStep) - sheet(s, t - kStep)) / (2.0 * kStep);
      const glm::dvec3 across = glm::cross(along_s, along_t);
      mesh.positions.push_back(sheet(s, t));
      mesh.normals.emplace_back(glm::normalize(across));
      radii.push_back(cell * std::sqrt(glm::length(across)));  // the side of its share of the area
      if (i + 1 == side || j + 1 == side) continue;
      const std::uint32_t corner = j * side + i;
      mesh.triangles.push_back({corner, corner + 1, corner + side + 1});
      mesh.triangles.push_back({corner, corner + side + 1, corner + side});
    }
  }
  append(to, mesh, radii, colour);
}

double wave(double x) {
  return std::sin(std::numbers::pi * x);
}

}  // namespace

Surfaces crossing_sheets(std::uint32_t side, float opacity) {
  Surfaces surfaces;
  append_sheet(
      surfaces,
      [](double s, double t) { return glm::dvec3(s, 0.35 * s + 0.15 * wave(2.0 * t), -t); }, 257,
      glm::vec4(kOrange, opacity));
  append_sheet(
      surfaces,
      [](double s, double t) { return glm::dvec3(s, -0.35 * s + 0.15 * wave(1.5 * s + 0.3), -t); },
      side, glm::vec4(kBlue, opacity));
  return surfaces;
}

Surfaces scan_through_sheet(const Points& scan, float opacity) {
  Surfaces surfaces;
  const NeighbourGraph graph = find_neighbours(scan.positions, kSurfaceNeighbours);
  append(surfaces, mesh_of_points(scan), find_radii(graph), glm::vec4(kOrange, opacity));
  std::vector<float> spacings = graph.spacing;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  const Bounds bounds = bounds_of(scan.positions);
  const glm::dvec3 centre = 0.5 * (bounds.min + bounds.max);
  const double reach = bounding_radius(scan.positions, bounds);
  const auto side = static_cast<std::uint32_t>(2.0 * reach / double{*middle}) + 1;
  append_sheet(
      surfaces,
      [&](double s, double t) {
        return centre + reach * glm::dvec3(s, 0.1 * s + 0.08 * wave(2.0 * t), -t);
      },
      side, glm::vec4(kBlue, opacity));
  return surfaces;
}

}  // namespace relief::experiment

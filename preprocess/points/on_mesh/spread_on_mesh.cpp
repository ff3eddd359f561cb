#include "preprocess/points/on_mesh/spread_on_mesh.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "common/flat_map.h"
#include "common/mesh/coarse_mesh.h"
#include "preprocess/points/no_point.h"
#include "preprocess/points/on_mesh/triangle_points.h"

namespace relief {
namespace {

// In steps. Rows of neighbouring triangles do not fit together; nearer points would be too many.
constexpr double kNearest = 0.6;
// Points whose normals are farther apart, 120 degrees, lie on two sides of a thin wall.
constexpr float kOppositeCosine = -0.5F;
// Places looked at, at most, per point asked for: needles could have any number.
constexpr std::size_t kMostLooks = 32;

/// Points of which none is near to an earlier one.
class SpacedPoints {
 public:
  SpacedPoints(const Points& mesh, double distance) : mesh_(mesh), distance_(distance) {
    for (const PointScalar& scalar : mesh.scalars) {
      points_.scalars.push_back(scalar);
      points_.scalars.back().values.clear();
    }
    points_.viewpoint = mesh.viewpoint;
    points_.is_airborne = mesh.is_airborne;
  }

  void add(std::uint32_t triangle, const Triangle& t, glm::dvec3 weights) {
    append_point(mesh_, t, weights, points_);
    glm::vec3& normal = points_.normals.back();
    if (glm::length(normal) > 0.0F) normal = glm::normalize(normal);
    const glm::dvec3 position = points_.positions.back();
    if (has_near(position, normal)) return drop_last();
    const std::uint32_t cube =
        cubes_.insert(key(cube_of(position)), static_cast<std::uint32_t>(first_.size()));
    if (cube == first_.size()) first_.push_back(kNoPoint);
    next_.push_back(first_[cube]);
    first_[cube] = static_cast<std::uint32_t>(points_.size() - 1);
    triangles_.push_back(triangle);
  }

  SpreadPoints take() { return {std::move(points_), std::move(triangles_)}; }

 private:
  [[nodiscard]] glm::dvec3 cube_of(glm::dvec3 position) const {
    return glm::floor(position / distance_);
  }
  /// Cubes may share a key: what is in them is looked at, too.
  static std::uint64_t key(glm::dvec3 cube) {
    const auto part = [](double x) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(x));
    };
    return (part(cube.x) * 0x9E3779B97F4A7C15U) ^ (part(cube.y) * 0xBF58476D1CE4E5B9U) ^
           (part(cube.z) * 0x94D049BB133111EBU);
  }

  [[nodiscard]] bool has_near(glm::dvec3 position, glm::vec3 normal) const {
    const glm::dvec3 middle = cube_of(position);
    for (int c = 0; c < 27; ++c) {
      const glm::dvec3 cube = middle + glm::dvec3(c % 3 - 1, c / 3 % 3 - 1, c / 9 - 1);
      const std::uint32_t at = cubes_.find(key(cube));
      if (at == FlatMap::kNone) continue;
      for (std::uint32_t i = first_[at]; i != kNoPoint; i = next_[i]) {
        if (glm::distance(points_.positions[i], position) < distance_ &&
            glm::dot(points_.normals[i], normal) >= kOppositeCosine)
          return true;
      }
    }
    return false;
  }

  void drop_last() {
    const auto drop = [](auto& values) {
      if (!values.empty()) values.pop_back();
    };
    drop(points_.positions);
    drop(points_.normals);
    drop(points_.colours);
    drop(points_.texcoords);
    for (PointScalar& scalar : points_.scalars) drop(scalar.values);
  }

  const Points& mesh_;
  double distance_;
  Points points_;
  std::vector<std::uint32_t> triangles_;
  FlatMap cubes_;                     ///< numbers of cubes
  std::vector<std::uint32_t> first_;  ///< in each cube
  std::vector<std::uint32_t> next_;   ///< in the same cube
};

/// Whether a mesh surely has no more places about `step` apart.
bool has_at_most(const Points& mesh, double step, std::size_t most) {
  const TrianglePoints places(mesh, 0.0, step);
  auto sum = static_cast<double>(mesh.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) sum += places.most_on(k);
  return sum <= static_cast<double>(most);
}

/// Calls `add(number of the triangle, corners, weights)` for the places of a mesh, about `step`
/// apart. Ends when that returns false, and returns whether it never did.
template <class Add>
bool for_each_place(const Points& mesh, double step, const Add& add) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<std::uint8_t> is_done(mesh.size(), 0);
  for (std::uint32_t k = 0; k < count; ++k) {
    for (const std::uint32_t i : mesh.triangles[k]) {
      if (std::exchange(is_done[i], std::uint8_t{1}) != 0) continue;
      if (!add(k, Triangle{i, i, i}, glm::dvec3(1.0, 0.0, 0.0))) return false;
    }
  }
  TrianglePoints places(mesh, 0.0, step);
  const auto add_of = [&add](std::uint32_t k) {
    return [&add, k](const Triangle& t, glm::dvec3 weights) { return add(k, t, weights); };
  };
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!places.on_edges(k, add_of(k))) return false;
  }
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!places.within(k, add_of(k))) return false;
  }
  return true;
}

}  // namespace

SpreadPoints spread_on_mesh(const Points& mesh, std::size_t count, const Progress& progress) {
  double step = std::sqrt(area_of_triangles(mesh) / static_cast<double>(count));
  if (!(step > 0.0) || !std::isfinite(step)) return {};
  const std::size_t most = kMostLooks * std::max(count, mesh.size());
  const auto fits = [&](double length) {
    if (has_at_most(mesh, length, most)) return true;
    std::size_t looks = 0;
    return for_each_place(
        mesh, length, [&](std::uint32_t, const Triangle&, glm::dvec3) { return ++looks <= most; });
  };
  while (!progress.cancelled() && !fits(step)) step *= 1.5;
  SpacedPoints spaced(mesh, kNearest * step);
  for_each_place(mesh, step, [&](std::uint32_t k, const Triangle& t, glm::dvec3 weights) {
    spaced.add(k, t, weights);
    return !progress.cancelled();
  });
  return spaced.take();
}

}  // namespace relief

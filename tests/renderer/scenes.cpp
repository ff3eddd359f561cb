#include "tests/renderer/scenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "common/octahedral.h"
#include "common/patch_file/continuation.h"

namespace relief::test {
namespace {

double bump(const SphereShape& shape, glm::dvec3 d) {
  const double f = shape.bump_frequency;
  return shape.bumps * std::sin(f * d.x + 1.0) * std::sin(f * d.y + 2.0) * std::sin(f * d.z + 0.5);
}

/// Where the line base + h * n meets the sphere nearest to h = 0, by Newton's method on
/// |p| - radius(p).
std::optional<SurfacePoint> hit_sphere(const SphereShape& shape, glm::dvec3 base, glm::dvec3 n) {
  const auto distance = [&shape](glm::dvec3 p) {
    const glm::dvec3 d = p - shape.centre;
    return glm::length(d) - sphere_radius(shape, d);
  };
  const double e = 1e-6 * shape.radius;
  double h = 0.0;
  for (int i = 0; i < 30; ++i) {
    const glm::dvec3 p = base + h * n;
    const double slope = (distance(p + e * n) - distance(p - e * n)) / (2.0 * e);
    if (slope < 0.05) return std::nullopt;
    h -= distance(p) / slope;
  }
  const glm::dvec3 p = base + h * n;
  if (std::abs(distance(p)) > 1e-6 * shape.radius) return std::nullopt;
  const glm::dvec3 gradient(distance(p + glm::dvec3(e, 0, 0)) - distance(p - glm::dvec3(e, 0, 0)),
                            distance(p + glm::dvec3(0, e, 0)) - distance(p - glm::dvec3(0, e, 0)),
                            distance(p + glm::dvec3(0, 0, e)) - distance(p - glm::dvec3(0, 0, e)));
  const glm::dvec3 d = glm::normalize(p - shape.centre);
  return SurfacePoint{h, glm::normalize(gradient), glm::u8vec3(127.5 + 127.0 * d)};
}

}  // namespace

Patch sample_patch(const Grid& grid, const Surface& surface, bool coloured) {
  Patch patch;
  patch.axes = grid.axes;
  patch.spacing = grid.spacing;
  patch.width = grid.width;
  patch.height = grid.height;
  const auto base = [&grid](double i, double j) {
    return grid.origin + grid.axes * glm::dvec3(i * grid.spacing, j * grid.spacing, 0.0);
  };
  std::vector<std::optional<SurfacePoint>> points;
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      points.push_back(surface(base(i, j)));
      if (!points.back()) continue;
      low = std::min(low, points.back()->height);
      high = std::max(high, points.back()->height);
    }
  }
  patch.height_step = std::max(grid.spacing / 1000.0, (high - low) / kMaxHeightRange);
  patch.origin = grid.origin + grid.axes[2] * low;
  for (const auto& point : points) {
    patch.heights.push_back(
        point ? static_cast<std::int32_t>(std::lround((point->height - low) / patch.height_step))
              : kHole);
  }

  const std::uint32_t scale = grid.normal_scale;
  patch.normals = {scale * (grid.width - 1) + 1, scale * (grid.height - 1) + 1, scale, {}};
  std::vector<std::uint8_t> kept;
  for (std::uint32_t j = 0; j < patch.normals.height; ++j) {
    for (std::uint32_t i = 0; i < patch.normals.width; ++i) {
      const auto point = surface(base(double{1} * i / scale, double{1} * j / scale));
      kept.push_back(point ? 1 : 0);
      patch.normals.texels.push_back(
          point ? snorm16_from_unit(glm::vec3(glm::transpose(grid.axes) * point->normal))
                : glm::i16vec2(0));
    }
  }
  continue_over_holes(patch.normals, kept);
  if (!coloured) return patch;
  patch.colours = {grid.width, grid.height, 1, {}};
  kept.clear();
  for (const auto& point : points) {
    kept.push_back(point ? 1 : 0);
    patch.colours.texels.push_back(point ? point->colour : glm::u8vec3(0));
  }
  continue_over_holes(patch.colours, kept);
  return patch;
}

glm::dmat3 axes_about(glm::dvec3 n) {
  const glm::dvec3 z = glm::normalize(n);
  const glm::dvec3 x = glm::normalize(
      glm::cross(std::abs(z.y) < 0.8 ? glm::dvec3(0.1, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.2), z));
  return {x, glm::cross(z, x), z};
}

PatchModel model_of(std::vector<Patch> patches) {
  PatchModel model;
  for_each_position(patches, [&](glm::dvec3 p) { extend(model.bounds, p); });
  const glm::dvec3 middle = 0.5 * (model.bounds.min + model.bounds.max);
  for_each_position(patches, [&](glm::dvec3 p) {
    model.bounding_radius = std::max(model.bounding_radius, glm::distance(p, middle));
  });
  model.spacing = patches.empty() ? 0.0 : patches.front().spacing;
  model.has_colours = !patches.empty() && !patches.front().colours.empty();
  model.patches = std::move(patches);
  return model;
}

double sphere_radius(const SphereShape& shape, glm::dvec3 direction) {
  return shape.radius * (1.0 + bump(shape, glm::normalize(direction)));
}

PatchModel sphere_model(const SphereShape& shape) {
  std::vector<Patch> patches;
  const int n = shape.patches_per_side;
  for (int face = 0; face < 6; ++face) {
    glm::dmat3 cube(0.0);  // columns: two directions along the face, its normal
    const int axis = face / 2;
    cube[2][axis] = face % 2 == 0 ? 1.0 : -1.0;
    cube[0][(axis + 1) % 3] = 1.0;
    cube[1] = glm::cross(cube[2], cube[0]);
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < n; ++a) {
        // Equal angles, so that patches are about equally large.
        const auto cut = [n](double k) { return std::tan((k / n - 0.5) * std::acos(-1.0) / 2.0); };
        const glm::dvec3 middle =
            glm::normalize(cube * glm::dvec3(cut(a + 0.5), cut(b + 0.5), 1.0));
        Grid grid;
        grid.axes = axes_about(middle);
        grid.spacing = shape.spacing;
        const double half = 1.15 * shape.radius * std::sin(std::acos(-1.0) / 4.0 / n * 1.42) +
                            (shape.overlap_cells + 1.0) * shape.spacing;
        const int cells = static_cast<int>(std::ceil(2.0 * half / shape.spacing));
        grid.width = grid.height = static_cast<std::uint32_t>(cells + 1);
        grid.origin = shape.centre + sphere_radius(shape, middle) * middle -
                      0.5 * cells * shape.spacing * (grid.axes[0] + grid.axes[1]);
        const double margin = shape.overlap_cells * shape.spacing / shape.radius;
        patches.push_back(sample_patch(
            grid,
            [&, a, b](glm::dvec3 base) -> std::optional<SurfacePoint> {
              const auto point = hit_sphere(shape, base, grid.axes[2]);
              if (!point) return std::nullopt;
              const glm::dvec3 d =
                  glm::transpose(cube) * (base + point->height * grid.axes[2] - shape.centre);
              if (d.z <= 0.0) return std::nullopt;
              const double x = std::atan(d.x / d.z);
              const double y = std::atan(d.y / d.z);
              const auto inside = [margin, &cut](double angle, int k) {
                return angle >= std::atan(cut(k)) - margin &&
                       angle <= std::atan(cut(k + 1)) + margin;
              };
              return inside(x, a) && inside(y, b) ? point : std::nullopt;
            },
            shape.coloured));
      }
    }
  }
  return model_of(std::move(patches));
}

PatchModel coarse_coloured_sphere() {
  SphereShape shape;
  shape.spacing = 0.1;
  shape.coloured = true;
  return sphere_model(shape);
}

PatchModel height_field(std::uint32_t nodes, const std::function<double(double, double)>& height) {
  Grid grid;
  grid.width = grid.height = nodes;
  const double half = 0.5 * (nodes - 1);
  grid.origin = {-half, -half, 0.0};
  const Patch patch = sample_patch(grid, [&height](glm::dvec3 p) {
    const double e = 0.01;
    const glm::dvec3 normal(height(p.x - e, p.y) - height(p.x + e, p.y),
                            height(p.x, p.y - e) - height(p.x, p.y + e), 2.0 * e);
    return SurfacePoint{height(p.x, p.y), glm::normalize(normal), glm::u8vec3(128)};
  });
  return model_of({patch});
}

}  // namespace relief::test

#include "viewer/measuring/surface_pick.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "common/mesh/nearest_on_triangle.h"
#include "common/seams/make_seams.h"
#include "renderer/engines/raytrace/meet_triangle.h"
#include "shaders/include/shared.h"
#include "viewer/measuring/corrected_hit.h"
#include "viewer/measuring/drawn_surface.h"
#include "viewer/measuring/surface_attributes.h"

namespace relief {
namespace {

// How far from what the GPU has drawn the surface may be: splats reach half a cell beyond it, the
// weighted depths of `multipass` are a cell off, and models seen from afar have triangles of two
// pixels.
constexpr double kCellsOff = 1.0;
constexpr double kPixelsOff = 1.5;

/// Single precision on the way to the depth of a pixel, as a part of it.
constexpr double kDepthError = 2e-6;

/// Cells around what was drawn that are looked at, each way, at most: 0.4 ms a pick (a sphere of
/// overlapping patches, 20 cells a pixel; 0.16 ms with one cell a pixel). Larger pixels show means
/// of cells.
constexpr double kMostCells = 24.0;

/// How many cells farther a splat may be that correction has moved the ray from.
constexpr double kCorrectionReach = 0.5 * shared::kSearchSteps + 0.5;

/// How much farther what was drawn may be from the plane of the triangle that the ray crosses than
/// from the nearest triangle. On a plane both are the same; what the ray crosses behind an edge
/// that it should have met is off by far more.
constexpr double kCrossingSlack = 4.0;

/// A patch in its place.
struct PlacedPatch {
  std::uint32_t number = 0;  ///< in PatchModel::patches
  Transform transform;
};

/// The patch of a number that counts through instances; nothing if the model has no such patch.
std::optional<PlacedPatch> find_patch(const PatchModel& model, std::uint32_t number) {
  if (model.instances.empty()) {
    if (number >= model.patches.size()) return std::nullopt;
    return PlacedPatch{number, {}};
  }
  for (const Instance& instance : model.instances) {
    if (number < instance.count) return PlacedPatch{instance.first + number, instance.transform};
    number -= instance.count;
  }
  return std::nullopt;
}

/// The ray of a query and what was drawn there, in the grid frame of a patch.
struct GridRay {
  glm::dvec3 start{0.0};
  glm::dvec3 direction{0.0};
  glm::dvec3 drawn{0.0};
  double pixel = 0.0;  ///< cells
};

/// Where a ray meets a triangle.
struct Meeting {
  glm::dvec3 position{0.0};
  double depth = 0.0;  ///< in lengths of the ray's direction
};

std::optional<Meeting> meeting(const GridTriangle& t, const GridRay& ray) {
  const auto hit = raytrace::meet_triangle(
      0, {t[0] - ray.start, t[1] - ray.start, t[2] - ray.start}, ray.direction);
  if (!hit) return std::nullopt;
  const glm::dvec3 w = hit->weights;
  return Meeting{w.x * t[0] + w.y * t[1] + w.z * t[2], hit->depth};
}

/// A position on a patch, in its grid frame.
struct Found {
  glm::dvec3 position{0.0};
  double distance = std::numeric_limits<double>::max();  ///< from what was drawn, cells
};

/// The position on triangles that is nearest to another, or `nearest` if that is nearer.
Found find_nearest(const std::vector<GridTriangle>& triangles, glm::dvec3 drawn,
                   Found nearest = {}) {
  for (const GridTriangle& t : triangles) {
    const glm::dvec3 position = nearest_on_triangle(drawn, t[0], t[1], t[2]);
    const double distance = glm::distance(position, drawn);
    if (distance < nearest.distance) nearest = {position, distance};
  }
  return nearest;
}

/// Of the positions that correction moves the ray's meetings with splats to, the one that is
/// nearest to what was drawn.
Found find_corrected(const Patch& patch, const std::vector<GridTriangle>& splats,
                     const GridRay& ray) {
  Found nearest;
  for (const GridTriangle& t : splats) {
    const auto hit = meeting(t, ray);
    if (!hit) continue;
    const auto corrected = corrected_hit(patch, hit->position, ray.direction);
    if (!corrected) continue;
    const double distance = glm::distance(*corrected, ray.drawn);
    if (distance < nearest.distance) nearest = {*corrected, distance};
  }
  return nearest;
}

/// Where the ray first crosses a triangle, among those whose planes are at most `off` cells from
/// what was drawn.
std::optional<glm::dvec3> find_crossing(const std::vector<GridTriangle>& triangles,
                                        const GridRay& ray, double off) {
  std::optional<glm::dvec3> first;
  double depth = std::numeric_limits<double>::max();
  for (const GridTriangle& t : triangles) {
    const auto hit = meeting(t, ray);
    if (!hit || hit->depth >= depth) continue;
    const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (std::abs(glm::dot(glm::normalize(across), ray.drawn - t[0])) > off) continue;
    depth = hit->depth;
    first = hit->position;
  }
  return first;
}

GridRay in_grid(const Patch& patch, const Transform& place, const PickQuery& query) {
  const glm::dmat3 back = glm::transpose(place.rotation) / place.scale;
  GridRay ray;
  ray.start = grid_position(patch, back * (query.start - place.translation));
  ray.direction = grid_direction(patch, back * query.direction);
  ray.drawn = ray.start + query.depth * ray.direction;
  ray.pixel = query.pixel / (place.scale * patch.spacing);
  return ray;
}

bool is_sound(const PickQuery& query) {
  const glm::dvec3 sum = query.start + query.direction;
  return std::isfinite(sum.x + sum.y + sum.z) && query.direction != glm::dvec3(0.0) &&
         query.depth > 0.0 && std::isfinite(query.depth) && query.pixel >= 0.0 &&
         std::isfinite(query.pixel);
}

}  // namespace

SurfacePicker::SurfacePicker(const PatchModel& model) : model_(&model) {
  for (const PatchRun& run : model.joined) {
    seams_.push_back(
        make_seams(std::span(model.patches).subspan(run.first, run.count), run.is_closed));
  }
}

std::optional<SurfacePoint> SurfacePicker::pick(const PickQuery& query) const {
  if (!is_sound(query)) return std::nullopt;
  if (const auto found = pick_on(query.patch, query)) return found;
  for (const std::uint32_t other : query.others) {
    if (const auto found = pick_on(other, query)) return found;
  }
  return std::nullopt;
}

std::optional<SurfacePoint> SurfacePicker::pick_on(std::uint32_t number,
                                                   const PickQuery& query) const {
  const auto placed = find_patch(*model_, number);
  if (!placed) return std::nullopt;
  const Patch& patch = model_->patches[placed->number];
  const GridRay ray = in_grid(patch, placed->transform, query);
  const double depth_error = kDepthError * glm::distance(ray.start, ray.drawn);
  const double most_off = kCellsOff + kPixelsOff * ray.pixel + depth_error;
  const double reach = std::min(std::ceil(most_off) + 1.0 + kCorrectionReach, kMostCells);

  DrawnTriangles triangles;
  const PatchRun* const run = run_of(*model_, placed->number);
  if (const auto range = nodes_about(patch, ray.drawn, reach))
    add_cells(patch, *range, run != nullptr, ray.pixel, triangles);
  if (run != nullptr) {
    const auto seams = static_cast<std::size_t>(run - model_->joined.data());
    add_seams(patch, seams_[seams], placed->number - run->first, ray.drawn, reach, triangles);
  }
  const Found corrected = find_corrected(patch, triangles.splats, ray);
  Found found = find_nearest(triangles.splats, ray.drawn, find_nearest(triangles.cells, ray.drawn));
  if (corrected.distance < found.distance) found = corrected;
  if (!(found.distance <= most_off)) return std::nullopt;
  const double off = kCrossingSlack * found.distance + depth_error;
  if (const auto crossing = find_crossing(triangles.cells, ray, off)) {
    found.position = *crossing;
  } else if (corrected.distance <= off) {
    found.position = corrected.position;
  } else if (const auto on_splat = find_crossing(triangles.splats, ray, off)) {
    found.position = *on_splat;
  }

  const Transform& place = placed->transform;
  SurfacePoint point;
  point.position = moved(place, world_position(patch, found.position));
  point.uv = glm::clamp(glm::dvec2(found.position), glm::dvec2(0.0),
                        glm::dvec2(patch.width - 1.0, patch.height - 1.0));
  point.normal = glm::normalize(place.rotation * (patch.axes * normal_at(patch, point.uv)));
  point.colour = stored_colour_at(patch, point.uv);
  point.patch = number;
  point.depth =
      glm::dot(found.position - ray.start, ray.direction) / glm::dot(ray.direction, ray.direction);
  return point;
}

}  // namespace relief

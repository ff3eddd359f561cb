#include "preprocess/resample/surroundings/patch_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "common/cross.h"
#include "preprocess/points/complete_frame.h"
#include "preprocess/resample/surroundings/grow_region.h"

namespace relief {
namespace {

// Margin points steeper than this (60 degrees) support no samples: a cell there is more than two
// spacings long, and points beyond a crest become spikes (docs/decisions/0032 has the figures).
constexpr float kMinSupportCosine = 0.5F;
// Exception: points at a slope of 53 degrees or more in their own region. At a border that is steep
// for both patches, neither would have a margin. They support samples unless they are twice as
// steep here (iron_scan, see-through pixels in twelve views of 1280x1024: 4, of which this closes
// 3; for every point instead, fandisk lost 0.6 dB to spikes at its creases).
constexpr float kSteepOwnCosine = 0.6F;
constexpr float kMinShareOfOwnCosine = 0.5F;
// The margin ends at this slope (80 degrees).
constexpr float kMinMarginCosine = 0.17F;
// A sheet no steeper than that rises by less than this over a length of 1 on the base plane. Points
// above are of other sheets: of 20,000 quads in a stack, each patch would collect its whole column.
constexpr double kMostMarginRise = 5.8;

/// Removes points that cannot be the farthest in any direction: those well inside the octagon of
/// the farthest points in eight directions.
std::vector<glm::dvec2> near_hull(const std::vector<glm::dvec2>& points) {
  constexpr std::array<glm::dvec2, 8> directions{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  std::array<glm::dvec2, 8> corners{};
  std::array<double, 8> farthest{};
  farthest.fill(-std::numeric_limits<double>::infinity());
  for (const glm::dvec2 p : points) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const double along = p.x * directions[d].x + p.y * directions[d].y;
      if (along <= farthest[d]) continue;
      farthest[d] = along;
      corners[d] = p;
    }
  }
  // Points as far as a corner after rounding must stay.
  const double rounding =
      1e-9 * (glm::distance(corners[0], corners[4]) + glm::distance(corners[2], corners[6]));
  std::vector<glm::dvec2> near;
  for (const glm::dvec2 p : points) {
    bool inside = true;
    for (std::size_t d = 0; d < corners.size() && inside; ++d) {
      const glm::dvec2 side = corners[(d + 1) % corners.size()] - corners[d];
      const glm::dvec2 to = p - corners[d];
      inside = side == glm::dvec2(0.0) || cross(side, to) > rounding * glm::length(side);
    }
    if (!inside) near.push_back(p);
  }
  return near;
}

// Directions along the smallest rectangle around the projected points: 45 turns of 2 degrees come
// within 1 % of the best area.
void turn_to_smallest_rectangle(const SurfaceSamples& samples, const Region& region, glm::dvec3& u,
                                glm::dvec3& v) {
  constexpr int kTurns = 45;
  double best_area = std::numeric_limits<double>::infinity();
  glm::dvec3 best_u = u;
  const glm::dvec3 base = samples.positions[region.points.front()];
  std::vector<glm::dvec2> projected;
  projected.reserve(region.points.size());
  for (const std::uint32_t i : region.points) {
    const glm::dvec3 d = samples.positions[i] - base;
    projected.emplace_back(glm::dot(d, u), glm::dot(d, v));
  }
  projected = near_hull(projected);
  for (int turn = 0; turn < kTurns; ++turn) {
    const double angle = turn * (std::numbers::pi / 2.0) / kTurns;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (const glm::dvec2 p : projected) {
      const glm::dvec2 q(c * p.x + s * p.y, c * p.y - s * p.x);
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
    const double area = (high.x - low.x) * (high.y - low.y);
    if (area < best_area) {
      best_area = area;
      best_u = c * u + s * v;
    }
  }
  u = glm::normalize(best_u);
}

/// Minimum cosine to the base-plane normal with which a margin point supports samples.
float min_support_cosine(float own_cosine) {
  return own_cosine < kSteepOwnCosine ? kMinShareOfOwnCosine * own_cosine : kMinSupportCosine;
}

}  // namespace

void place_points(const SurfaceSamples& samples, PatchPoints& points) {
  const glm::mat3 to_local(glm::transpose(points.frame.axes));
  points.positions.reserve(points.size());
  points.normals.reserve(points.size());
  points.spacing.reserve(points.size());
  for (const std::uint32_t i : points.ids) {
    points.positions.push_back(points.frame.to_local(samples.positions[i]));
    points.normals.push_back(to_local * samples.normals[i]);
    points.spacing.push_back(samples.spacing[i]);
  }
}

PatchPoints collect_patch_points(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                 const Region& region, const Membership& membership, double margin,
                                 float own_spacing) {
  PatchPoints out;
  const glm::dvec3 n = glm::normalize(glm::dvec3(region.normal));
  glm::dvec3 u;
  glm::dvec3 v;
  complete_frame(n, u, v);
  turn_to_smallest_rectangle(samples, region, u, v);
  out.frame.axes = glm::dmat3(u, glm::cross(n, u), n);

  out.ids = region.points;
  out.own = region.points.size();
  if (margin > 0.0) {
    const auto is_margin = [&](std::uint32_t from, std::uint32_t i, std::uint32_t j) {
      const glm::dvec3 step = samples.positions[j] - samples.positions[from];
      const double rise = glm::dot(step, glm::dvec3(region.normal));
      return std::abs(rise) <= kMostMarginRise * margin &&
             glm::dot(step, step) - rise * rise <= margin * margin &&
             glm::dot(samples.normals[j], region.normal) >= kMinMarginCosine &&
             on_one_sheet(samples, i, j, from == i ? own_spacing : 0.0F);
    };
    grow_region(graph, region, membership.region, is_margin, out.ids);
  }
  const auto margin_begin = out.ids.begin() + static_cast<std::ptrdiff_t>(out.own);
  std::sort(margin_begin, out.ids.end());
  const auto steep = std::stable_partition(margin_begin, out.ids.end(), [&](std::uint32_t i) {
    return glm::dot(samples.normals[i], region.normal) >= min_support_cosine(membership.cosine[i]);
  });
  out.supporting = static_cast<std::size_t>(steep - out.ids.begin());

  glm::dvec3 centroid(0.0);
  const glm::dvec3 base = samples.positions[region.points.front()];
  for (const std::uint32_t i : region.points) centroid += samples.positions[i] - base;
  out.frame.origin = base + centroid / static_cast<double>(out.own);

  place_points(samples, out);
  return out;
}

}  // namespace relief

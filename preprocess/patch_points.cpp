#include "preprocess/patch_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace relief {
namespace {

// Margin points steeper than this (60 degrees) support no samples: a cell there is more than two
// spacings long, and what sticks out beyond a crest is a spike (docs/decisions.md has the figures).
constexpr float kLeastSupportCosine = 0.5F;
// But those that their own region too sees at a slope of 53 degrees or more: where a border is
// steep for both its patches, neither would have a margin. They support samples if they are not
// twice as steep here (iron_scan, see-through pixels in twelve views of 1280x1024: 4, of which this
// closes 3; for every point instead, fandisk lost 0.6 dB to spikes at its creases).
constexpr float kSteepOwnCosine = 0.6F;
constexpr float kLeastShareOfOwnCosine = 0.5F;
// Nor is the margin followed beyond this slope (80 degrees).
constexpr float kLeastMarginCosine = 0.17F;
// Steepest slope that a tangent plane is followed to (84 degrees, the limit of all regions).
constexpr float kLeastCosine = 0.1F;

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

// Grows outward from the region over the neighbour graph. Each reached point remembers the region's
// point it was reached from; the distance to that one on the base plane is what `margin` limits.
void grow_margin(const SurfaceSamples& samples, const NeighbourGraph& graph, const Region& region,
                 double margin, std::vector<std::uint32_t>& ids) {
  std::unordered_map<std::uint32_t, std::uint32_t> source;
  source.reserve(region.points.size() * 2);
  for (const std::uint32_t i : region.points) source.emplace(i, i);
  std::vector<std::uint32_t> front = region.points;
  while (!front.empty()) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t i : front) {
      const std::uint32_t from = source[i];
      for (const std::uint32_t j : graph.of(i)) {
        const glm::dvec3 step = samples.positions[j] - samples.positions[from];
        const double rise = glm::dot(step, glm::dvec3(region.normal));
        if (glm::dot(step, step) - rise * rise > margin * margin) continue;
        if (glm::dot(samples.normals[j], region.normal) < kLeastMarginCosine) continue;
        if (!on_one_sheet(samples, i, j)) continue;
        if (!source.emplace(j, from).second) continue;
        next.push_back(j);
        ids.push_back(j);
      }
    }
    front = std::move(next);
  }
}

/// The least cosine to the base-plane normal with which a margin point supports samples.
float least_support_cosine(float own_cosine) {
  return own_cosine < kSteepOwnCosine ? kLeastShareOfOwnCosine * own_cosine : kLeastSupportCosine;
}

}  // namespace

double tangent_height(const PatchPoints& points, std::uint32_t point, double x, double y) {
  const glm::dvec3 p = points.positions[point];
  const glm::vec3 n = points.normals[point];
  const double steep = std::max(n.z, kLeastCosine);
  return p.z - (n.x * (x - p.x) + n.y * (y - p.y)) / steep;
}

PatchPoints collect_patch_points(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                 const Region& region, const std::vector<float>& own_cosines,
                                 double margin) {
  PatchPoints out;
  const glm::dvec3 n = glm::normalize(glm::dvec3(region.normal));
  glm::dvec3 u;
  glm::dvec3 v;
  complete_frame(n, u, v);
  turn_to_smallest_rectangle(samples, region, u, v);
  out.frame.axes = glm::dmat3(u, glm::cross(n, u), n);

  out.ids = region.points;
  out.own = region.points.size();
  grow_margin(samples, graph, region, margin, out.ids);
  const auto margin_begin = out.ids.begin() + static_cast<std::ptrdiff_t>(out.own);
  std::sort(margin_begin, out.ids.end());
  const auto steep = std::stable_partition(margin_begin, out.ids.end(), [&](std::uint32_t i) {
    return glm::dot(samples.normals[i], region.normal) >= least_support_cosine(own_cosines[i]);
  });
  out.supporting = static_cast<std::size_t>(steep - out.ids.begin());

  glm::dvec3 centroid(0.0);
  const glm::dvec3 base = samples.positions[region.points.front()];
  for (const std::uint32_t i : region.points) centroid += samples.positions[i] - base;
  out.frame.origin = base + centroid / static_cast<double>(out.own);

  const glm::mat3 to_local(glm::transpose(out.frame.axes));
  for (const std::uint32_t i : out.ids) {
    out.positions.push_back(out.frame.to_local(samples.positions[i]));
    out.normals.push_back(to_local * samples.normals[i]);
    out.spacing.push_back(samples.spacing[i]);
  }
  return out;
}

}  // namespace relief

#include "preprocess/resample/patch_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

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
      inside =
          side == glm::dvec2(0.0) || side.x * to.y - side.y * to.x > rounding * glm::length(side);
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

/// A set of points. Open addressing, at most half full.
class PointSet {
 public:
  [[nodiscard]] bool has(std::uint32_t point) const { return slots_[slot_of(point)] == point; }

  void add(std::uint32_t point) {
    slots_[slot_of(point)] = point;
    if (2 * ++count_ <= slots_.size()) return;
    std::vector<std::uint32_t> old(2 * slots_.size(), kEmpty);
    old.swap(slots_);
    for (const std::uint32_t p : old) {
      if (p != kEmpty) slots_[slot_of(p)] = p;
    }
  }

 private:
  static constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();

  /// Returns the slot of a point, or the free slot for it.
  [[nodiscard]] std::size_t slot_of(std::uint32_t point) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (point * 0x9E3779B97F4A7C15ULL >> 32U) & mask;
    while (slots_[slot] != kEmpty && slots_[slot] != point) slot = (slot + 1) & mask;
    return slot;
  }

  std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(1024, kEmpty);
  std::size_t count_ = 0;
};

// Grows outward from the region through the neighbour graph. Each reached point remembers the
// region's point from which it was reached; `margin` limits their distance on the base plane.
void grow_margin(const SurfaceSamples& samples, const NeighbourGraph& graph, const Region& region,
                 const std::vector<std::uint32_t>& region_of, double margin,
                 std::vector<std::uint32_t>& ids) {
  struct Reached {
    std::uint32_t point;
    std::uint32_t from;
  };
  const std::uint32_t own = region_of[region.points.front()];
  PointSet seen;
  std::vector<Reached> front;
  front.reserve(region.points.size());
  for (const std::uint32_t i : region.points) front.push_back({i, i});
  while (!front.empty()) {
    std::vector<Reached> next;
    for (const auto [i, from] : front) {
      for (const std::uint32_t j : graph.of(i)) {
        if (region_of[j] == own || seen.has(j)) continue;
        const glm::dvec3 step = samples.positions[j] - samples.positions[from];
        const double rise = glm::dot(step, glm::dvec3(region.normal));
        if (glm::dot(step, step) - rise * rise > margin * margin) continue;
        if (glm::dot(samples.normals[j], region.normal) < kMinMarginCosine) continue;
        if (!on_one_sheet(samples, i, j)) continue;
        seen.add(j);
        next.push_back({j, from});
        ids.push_back(j);
      }
    }
    front = std::move(next);
  }
}

/// Minimum cosine to the base-plane normal with which a margin point supports samples.
float min_support_cosine(float own_cosine) {
  return own_cosine < kSteepOwnCosine ? kMinShareOfOwnCosine * own_cosine : kMinSupportCosine;
}

}  // namespace

PatchPoints collect_patch_points(const SurfaceSamples& samples, const NeighbourGraph& graph,
                                 const Region& region, const Membership& membership,
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
  if (margin > 0.0) grow_margin(samples, graph, region, membership.region, margin, out.ids);
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

  const glm::mat3 to_local(glm::transpose(out.frame.axes));
  out.positions.reserve(out.size());
  out.normals.reserve(out.size());
  out.spacing.reserve(out.size());
  for (const std::uint32_t i : out.ids) {
    out.positions.push_back(out.frame.to_local(samples.positions[i]));
    out.normals.push_back(to_local * samples.normals[i]);
    out.spacing.push_back(samples.spacing[i]);
  }
  return out;
}

}  // namespace relief

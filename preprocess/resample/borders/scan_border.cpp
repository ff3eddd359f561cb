#include "preprocess/resample/borders/scan_border.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "preprocess/points/complete_frame.h"
#include "preprocess/resample/borders/density_steps.h"
#include "preprocess/resample/support/sectors.h"

namespace relief {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
// A point is at a border if no other lies in a sector of its tangent plane as wide as this, within
// so many spacings ...
constexpr double kEmptySector = 130.0 * kDegree;
constexpr double kEmptyReach = 2.5;
// ... and no other sector without points is nearly as wide, as both sides of a wire are, nor is it
// the end of one.
constexpr double kWidestOther = 110.0 * kDegree;
constexpr double kWidestEmpty = 290.0 * kDegree;

// Where a scanner sees a surface askew, its depths are in steps: over those a gap is still one, so
// many spacings wide.
constexpr double kWidestStep = 10.0;

// Normals turn by 45 degrees at a sharp edge, and what lies beyond it begins at most so many
// spacings inward of a point there.
constexpr float kTurnAtEdge = 0.7F;
constexpr double kNearEdge = 0.2;

// Points of a border weigh exp(-d^2 / s^2), s in scan spacings, up to so many of s away ...
constexpr double kCurveScale = 2.0;
constexpr double kCurveCutoff = 2.0;
// ... more where they lie farther outward, by this power of e a spacing, ...
constexpr double kOuterWeight = 0.5;
// ... and exp(-t^2 / s^2), t the difference of their directions and the mean one: at a corner the
// points of its other side do not count.
constexpr double kDirectionScale = 0.7;
// Fewer tell of no curve.
constexpr std::size_t kFewestPoints = 3;
// Points at the border of another sheet are farther from the tangent plane than this, in spacings,
// or turned by 60 degrees.
constexpr double kOffSheet = 1.0;
constexpr float kLeastCosine = 0.5F;
// The scan ends beyond the curve by this, in spacings: half a spacing of a regular grid, 0.4 of a
// jittered one, 0.46 of a random one (simulated along straight lines; 0.33 at the rim of a hole of
// radius 7, 0.51 of a disc of radius 12). The rest of what is random, 0.15 to 0.26 (standard
// deviation), stays. It would be 0.36 with the points' own directions instead of their mean.
constexpr double kBeyondPoints = 0.4;

/// Looks at points one by one.
class BorderFinder {
 public:
  BorderFinder(const SurfaceSamples& samples, const NeighbourGraph& graph)
      : samples_(samples), graph_(graph) {}

  /// The direction outward from a point at a border, in its tangent plane; nothing of another.
  std::optional<glm::dvec3> outward(std::uint32_t i) {
    const glm::dvec3 n(samples_.normals[i]);
    if (n == glm::dvec3(0.0)) return {};
    complete_frame(n, u_, v_);
    // Nine of ten points are done with here.
    TwelveSectors sectors;
    for (const std::uint32_t j : graph_.of(i)) {
      const glm::dvec2 d = in_plane(i, j);
      sectors.add(d.x, d.y);
    }
    static_assert(kEmptySector >= 120.0 * kDegree);
    if (!sectors.may_leave_120_degrees()) return {};
    angles_.clear();
    for (const std::uint32_t j : graph_.of(i)) add(i, j);
    // A point at a border of rows has its nearest along its own row, so that theirs are asked, too.
    if (widest_sectors(angles_).width < kEmptySector) return {};
    const double reach = kEmptyReach * samples_.spacing[i];
    angles_.clear();
    for (const std::uint32_t j : graph_.of(i)) {
      add_within(i, j, reach);
      for (const std::uint32_t k : graph_.of(j)) add_within(i, k, reach);
    }
    const WidestSectors widest = widest_sectors(angles_);
    if (widest.width < kEmptySector || widest.width > kWidestEmpty || widest.second > kWidestOther)
      return {};
    const double middle = widest.begin + 0.5 * widest.width;
    return std::cos(middle) * u_ + std::sin(middle) * v_;
  }

 private:
  [[nodiscard]] glm::dvec2 in_plane(std::uint32_t i, std::uint32_t j) const {
    const glm::dvec3 d = samples_.positions[j] - samples_.positions[i];
    return {glm::dot(d, u_), glm::dot(d, v_)};
  }

  void add(std::uint32_t i, std::uint32_t j) {
    const glm::dvec2 d = in_plane(i, j);
    if (d != glm::dvec2(0.0)) angles_.push_back(std::atan2(d.y, d.x));
  }

  void add_within(std::uint32_t i, std::uint32_t j, double reach) {
    const glm::dvec3 d = samples_.positions[j] - samples_.positions[i];
    if (j != i && glm::dot(d, d) <= reach * reach) add(i, j);
  }

  const SurfaceSamples& samples_;
  const NeighbourGraph& graph_;
  glm::dvec3 u_{0.0};
  glm::dvec3 v_{0.0};
  std::vector<double> angles_;
};

/// Whether there are points beyond what looks like a border at a point.
bool is_gap(const SurfaceSamples& samples, const RadiusSearch& all, std::uint32_t i,
            glm::dvec3 outward) {
  const double gap = kWidestGap * samples.spacing[i];
  const glm::dvec3 normal(samples.normals[i]);
  const double reach = kWidestStep * samples.spacing[i];
  return all.any(samples.positions[i], reach, [&](std::uint32_t j) {
    const glm::dvec3 d = samples.positions[j] - samples.positions[i];
    const double across = std::abs(glm::dot(d, normal));
    const double within = glm::length(d - glm::dot(d, normal) * normal);
    const double along = glm::dot(d, outward);
    if (!(along > 0.0 && along >= kGapCosine * within)) return false;
    return across >= within || glm::dot(d, d) <= gap * gap;
  });
}

/// Whether a point is at a sharp edge, beyond which the surface goes on with other normals: the
/// face there is seen edge-on.
bool is_at_edge(const SurfaceSamples& samples, const RadiusSearch& all, std::uint32_t i,
                glm::dvec3 outward) {
  const double reach = kEmptyReach * samples.spacing[i];
  return all.any(samples.positions[i], reach, [&](std::uint32_t j) {
    return glm::dot(samples.normals[i], samples.normals[j]) < kTurnAtEdge &&
           glm::dot(samples.positions[j] - samples.positions[i], outward) >
               -kNearEdge * samples.spacing[i];
  });
}

}  // namespace

ScanBorder::ScanBorder(const SurfaceSamples& samples, const NeighbourGraph& graph,
                       std::uint32_t of_others) {
  const auto count =
      static_cast<std::uint32_t>(std::min<std::size_t>(samples.positions.size(), of_others));
  std::vector<std::optional<glm::dvec3>> outward(count);
  tbb::enumerable_thread_specific<BorderFinder> finders(
      [&] { return BorderFinder(samples, graph); });
  tbb::parallel_for(std::uint32_t{0}, count,
                    [&](std::uint32_t i) { outward[i] = finders.local().outward(i); });
  if (std::ranges::none_of(outward, [](const auto& o) { return o.has_value(); })) return;
  const RadiusSearch all(samples.positions);
  const DensitySteps steps(samples, graph);
  std::vector<std::uint8_t> at_edge(count, 0);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t i) {
    if (!outward[i]) return;
    if (is_gap(samples, all, i, *outward[i]) || steps.go_on(i, *outward[i]))
      outward[i].reset();
    else
      at_edge[i] = is_at_edge(samples, all, i, *outward[i]) ? 1 : 0;
  });
  std::vector<glm::dvec3> positions;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!outward[i]) continue;
    count_ += at_edge[i] != 0 ? 0 : 1;
    positions.push_back(samples.positions[i]);
    points_.push_back({samples.positions[i], samples.normals[i], glm::vec3(*outward[i])});
  }
  if (!positions.empty()) search_.emplace(positions);
}

std::optional<double> ScanBorder::beyond(glm::dvec3 position, glm::vec3 normal,
                                         double spacing) const {
  if (!search_ || !(spacing > 0.0)) return {};
  const double scale = kCurveScale * spacing;
  std::vector<std::uint32_t> found;
  search_->find(position, kCurveCutoff * scale, found);
  std::erase_if(found, [&](std::uint32_t p) {
    const Point& point = points_[p];
    return std::abs(glm::dot(normal, point.normal)) < kLeastCosine ||
           std::abs(glm::dot(position - point.position, glm::dvec3(point.normal))) >
               kOffSheet * spacing;
  });
  if (found.size() < kFewestPoints) return {};
  std::vector<double> weights;
  for (const std::uint32_t p : found) {
    const glm::dvec3 d = position - points_[p].position;
    weights.push_back(std::exp(-glm::dot(d, d) / (scale * scale)));
  }
  const auto mean_outward = [&] {
    glm::dvec3 sum(0.0);
    for (std::size_t k = 0; k < found.size(); ++k)
      sum += weights[k] * glm::dvec3(points_[found[k]].outward);
    return sum / std::max(glm::length(sum), std::numeric_limits<double>::min());
  };
  const glm::dvec3 about = mean_outward();
  for (std::size_t k = 0; k < found.size(); ++k) {
    const glm::dvec3 turn = glm::dvec3(points_[found[k]].outward) - about;
    weights[k] *= std::exp(-glm::dot(turn, turn) / (kDirectionScale * kDirectionScale));
  }
  const glm::dvec3 outward = mean_outward();
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double before = glm::dot(position - points_[found[k]].position, outward);
    const double own = weights[k] * std::exp(-kOuterWeight * before / spacing);
    sum += own * before;
    weight += own;
  }
  if (!(weight > std::numeric_limits<double>::min())) return {};
  return sum / weight - kBeyondPoints * spacing;
}

}  // namespace relief

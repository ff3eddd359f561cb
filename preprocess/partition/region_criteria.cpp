#include "preprocess/partition/region_criteria.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "preprocess/points/complete_frame.h"

namespace relief {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// Cells of 1.5 spacings hold two points of a sheet on average, so that a second sheet is met.
constexpr double kCellInSpacings = 1.5;
// Noise of twice its rms does not make a second sheet.
constexpr double kToleranceInRoughness = 2.0;
// Neighbours farther apart than this many spacings are not connected. A scan whose density changes
// by a factor of four from one point to the next still is.
constexpr double kLongestHop = 6.0;
// More points in one cell than this need not all be compared with each other.
constexpr int kMaxCompared = 8;
// A unit vector's squared length after rounding to single precision, or less.
constexpr double kSurelyWithin = 0.99999;

std::int32_t floor_to_int(double value) {
  const auto cut = static_cast<std::int32_t>(value);
  return static_cast<double>(cut) > value ? cut - 1 : cut;
}

}  // namespace

bool on_one_sheet(const SurfaceSamples& samples, std::uint32_t i, std::uint32_t j,
                  float least_spacing) {
  if (!(glm::dot(samples.normals[i], samples.normals[j]) > 0.0F)) return false;
  // The finer of both densities decides: an outlier's own would allow any distance.
  const double rough = std::min(samples.roughness[i], samples.roughness[j]);
  const double spacing = std::max(least_spacing, std::min(samples.spacing[i], samples.spacing[j]));
  const glm::dvec3 hop = samples.positions[j] - samples.positions[i];
  const double longest = kLongestHop * spacing;
  if (!(glm::dot(hop, hop) <= longest * longest)) return false;
  // Along the mean normal; squared, which spares two square roots.
  const glm::dvec3 sum(samples.normals[i] + samples.normals[j]);
  const double along = glm::dot(sum, hop);
  const double tolerance = std::max(kSheetTolerance * spacing, kToleranceInRoughness * rough);
  return along * along <= tolerance * tolerance * glm::dot(sum, sum);
}

SheetScale sheet_scale(const SurfaceSamples& samples, std::span<const std::uint32_t> points,
                       double sheet_tolerance) {
  double area = 0.0;
  double roughness = 0.0;
  for (const std::uint32_t i : points) {
    area += double{samples.spacing[i]} * samples.spacing[i];
    roughness += samples.roughness[i];
  }
  const auto count = static_cast<double>(points.size());
  const double spacing = std::sqrt(area / count);
  return {kCellInSpacings * spacing,
          std::max(sheet_tolerance * spacing, kToleranceInRoughness * roughness / count)};
}

RegionTest::RegionTest(const SurfaceSamples& samples, const RegionLimits& limits)
    : samples_(samples),
      cos_cone_(static_cast<float>(std::cos(glm::radians(limits.cone_degrees)))),
      cone_(std::acos(cos_cone_)),
      sheet_tolerance_(limits.sheet_tolerance) {}

std::optional<glm::vec3> RegionTest::fit_cone(std::span<const std::uint32_t> points) {
  glm::vec3 sum(0.0F);
  normals_.resize(points.size());
  for (std::size_t m = 0; m < points.size(); ++m) {
    const std::uint32_t i = points[m];
    normals_.set(m, samples_.normals[i]);
    sum += samples_.spacing[i] * samples_.spacing[i] * samples_.normals[i];
  }
  const float length = glm::length(sum);
  if (!(length > 0.0F)) return std::nullopt;
  glm::vec3 axis = sum / length;
  // Badoiu and Clarkson: steps of 1/(m+1) towards the farthest normal converge on the centre of the
  // smallest enclosing cap. 12 steps come within about a degree.
  constexpr int kSteps = 12;
  for (int step = 1; step <= kSteps; ++step) {
    const float smallest = normals_.min_cosine(axis);
    if (smallest >= cos_cone_) return axis;
    // Moving the axis cannot gain 25 degrees, because it starts near the middle.
    if (step == 1 && std::acos(std::clamp(smallest, -1.0F, 1.0F)) > cone_ + glm::radians(25.0F)) {
      return std::nullopt;
    }
    const glm::vec3 worst = normals_.at(normals_.find(axis, smallest));
    axis = glm::normalize(axis + (worst - axis) / static_cast<float>(step + 3));
  }
  return std::nullopt;
}

bool RegionTest::single_valued(std::span<const std::uint32_t> points, glm::vec3 normal) {
  glm::dvec3 u;
  glm::dvec3 v;
  complete_frame(glm::dvec3(normal), u, v);
  const auto [cell, tolerance] = sheet_scale(samples_, points, sheet_tolerance_);

  // Gathered first, because the table accesses it in random order.
  positions_.resize(points.size());
  cells_.resize(points.size());
  glm::ivec2 low(std::numeric_limits<std::int32_t>::max());
  glm::ivec2 high(std::numeric_limits<std::int32_t>::min());
  const glm::dvec3 base = samples_.positions[points.front()];
  for (std::size_t m = 0; m < points.size(); ++m) {
    positions_[m] = samples_.positions[points[m]];
    const glm::dvec3 d = positions_[m] - base;
    const glm::dvec2 at = glm::dvec2(glm::dot(d, u), glm::dot(d, v)) / cell;
    cells_[m] = {floor_to_int(at.x), floor_to_int(at.y)};
    low = glm::min(low, cells_[m]);
    high = glm::max(high, cells_[m]);
  }

  // Most regions fill much of the rectangle around them. Then each cell has its own slot, and
  // adjacent ones are in one cache line; others are hashed.
  const std::int64_t columns = std::int64_t{high.x} - low.x + 1;
  const std::int64_t rows = std::int64_t{high.y} - low.y + 1;
  const std::size_t capacity = std::bit_ceil(points.size() * 2);
  const bool is_compact =
      static_cast<double>(columns) * static_cast<double>(rows) <= static_cast<double>(capacity);
  table_.assign(capacity, kNone);
  const auto own_slot = [&](std::size_t m) {
    const glm::ivec2 at = cells_[m] - low;
    return static_cast<std::size_t>(at.y * columns + at.x);
  };
  const auto hashed_slot = [&](std::size_t m) {
    const std::uint64_t key = std::uint64_t{static_cast<std::uint32_t>(cells_[m].x)} << 32 |
                              static_cast<std::uint32_t>(cells_[m].y);
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL >> 20) & (capacity - 1);
    while (table_[slot] != kNone && cells_[table_[slot]] != cells_[m])
      slot = (slot + 1) & (capacity - 1);
    return slot;
  };
  return is_compact ? lie_on_one_sheet(own_slot, tolerance)
                    : lie_on_one_sheet(hashed_slot, tolerance);
}

template <class SlotOf>
bool RegionTest::lie_on_one_sheet(const SlotOf& slot_of, double tolerance) {
  next_.resize(positions_.size());
  for (std::uint32_t m = 0; m < positions_.size(); ++m) {
    std::uint32_t& last = table_[slot_of(m)];
    next_[m] = last;
    last = m;
    int compared = 0;
    for (std::uint32_t o = next_[m]; o != kNone && compared < kMaxCompared;
         o = next_[o], ++compared) {
      const glm::dvec3 apart = positions_[m] - positions_[o];
      // Most pairs are closer than the tolerance; the mean normal is unit up to rounding.
      if (glm::dot(apart, apart) < kSurelyWithin * tolerance * tolerance) continue;
      const glm::vec3 mean = glm::normalize(normals_.at(m) + normals_.at(o));
      if (std::abs(glm::dot(glm::dvec3(mean), apart)) > tolerance) return false;
    }
  }
  return true;
}

std::optional<glm::vec3> RegionTest::fit(std::span<const std::uint32_t> points) {
  const std::optional<glm::vec3> axis = fit_cone(points);
  if (!axis || !single_valued(points, *axis)) return std::nullopt;
  return axis;
}

}  // namespace relief

#include "viewer/document/scan_points.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "common/is_finite.h"
#include "common/octahedral.h"
#include "common/transform.h"

namespace relief {
namespace {

/// sRGB of a point without a colour that faces down, and what it has more if it faces up.
constexpr float kDarkest = 70.0F;
constexpr float kRange = 150.0F;

/// Multiples of it are spread evenly over the numbers from 0 to 1, whatever their count.
constexpr double kGolden = 0.618033988749895;

/// Calls `visit` with `kept` of the places 0 to count - 1, spread over all of them in an order that
/// looks random: the step is near the golden ratio of `count` and has no factor in common with it,
/// so that no place comes twice. `count` is at least 1, `kept` at most that.
template <class Visit>
void for_each_spread(std::size_t count, std::size_t kept, const Visit& visit) {
  auto step = std::max<std::size_t>(1, static_cast<std::size_t>(kGolden * double(count)));
  while (std::gcd(step, count) != 1) ++step;
  for (std::size_t k = 0, index = 0; k < kept; ++k, index = (index + step) % count) visit(index);
}

/// Grey that is lit from above. `normal`: of any length.
glm::u8vec4 grey_of(const glm::vec3& normal, const glm::vec3& up) {
  float facing = 0.5F;
  const float length = glm::length(normal);
  if (std::isfinite(length) && length > 0.0F) facing += 0.5F * glm::dot(normal, up) / length;
  return {glm::u8vec3(static_cast<std::uint8_t>(kDarkest + kRange * facing)), 255};
}

glm::u8vec4 colour_of(const Points& points, std::size_t index, const glm::vec3& up) {
  if (!points.colours.empty()) return {points.colours[index], 255};
  return grey_of(points.normals.empty() ? glm::vec3(0.0F) : points.normals[index], up);
}

glm::u8vec4 colour_of(const Patch& patch, std::uint32_t i, std::uint32_t j, const glm::vec3& up) {
  if (!patch.colours.empty()) return {texel_at(patch.colours, i, j), 255};
  const glm::dvec3 normal =
      patch.normals.empty()
          ? patch.axes[2]
          : patch.axes * glm::dvec3(unit_from_snorm16(texel_at(patch.normals, i, j)));
  return grey_of(glm::vec3(normal), up);
}

/// The spacing of nearly all samples, or less: points as large as the mean leave gaps.
double wide_spacing_of(const std::vector<Patch>& patches) {
  std::vector<std::pair<double, std::size_t>> samples;  // by spacing
  std::size_t total = 0;
  for (const Patch& patch : patches) {
    samples.emplace_back(patch.spacing, count_samples(patch));
    total += samples.back().second;
  }
  std::sort(samples.begin(), samples.end());
  std::size_t finer = 0;
  for (const auto& [spacing, count] : samples) {
    finer += count;
    if (20 * finer >= 19 * total) return spacing;
  }
  return 0.0;
}

/// As if the points were spread evenly over half the surface of their box.
double spacing_of(const Bounds& bounds, std::size_t count) {
  const glm::dvec3 s = bounds.max - bounds.min;
  return std::sqrt((s.x * s.y + s.y * s.z + s.z * s.x) / static_cast<double>(count));
}

}  // namespace

ScanPoints scan_points_of(const Points& points) {
  ScanPoints shown;
  const std::size_t count = points.size();
  shown.total = count;
  if (count == 0) return shown;
  set_extent(shown.extent, points.positions);
  shown.extent.stance = stance_of(points);
  const Bounds& bounds = shown.extent.bounds;
  shown.origin = 0.5 * (bounds.min + bounds.max);
  const std::size_t kept = std::min(count, kMostShownPoints);
  shown.points.reserve(kept);
  const glm::vec3 up(shown.extent.stance.up);
  for_each_spread(count, kept, [&](std::size_t index) {
    const glm::dvec3& position = points.positions[index];
    if (is_finite(position))
      shown.points.push_back({glm::vec3(position - shown.origin), colour_of(points, index, up)});
  });
  shown.is_lit = points.colours.empty() && !points.normals.empty();
  shown.spacing = spacing_of(bounds, std::max<std::size_t>(shown.points.size(), 1));
  shown.extent.spacing = shown.spacing;
  return shown;
}

ScanPoints scan_points_of(const PatchModel& given) {
  ScanPoints shown;
  shown.extent = without_patches(given);
  const PatchModel baked = given.instances.empty() ? PatchModel() : bake(given);
  const PatchModel& placed = given.instances.empty() ? given : baked;
  shown.origin = 0.5 * (given.bounds.min + given.bounds.max);
  const glm::vec3 up(given.stance.up);
  const std::size_t count = count_samples(placed);
  if (count == 0) return shown;
  const double share = std::min(1.0, double{kMostShownSamples} / static_cast<double>(count));
  std::vector<ShownPoint> samples;
  double place = 0.0;
  for (const Patch& patch : placed.patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        place += kGolden;
        place -= std::floor(place);
        if (place >= share) continue;
        samples.push_back(
            {glm::vec3(position_of(patch, i, j) - shown.origin), colour_of(patch, i, j, up)});
      }
    }
  }
  const std::size_t kept = samples.size();
  shown.points.reserve(kept);
  for_each_spread(kept, kept, [&](std::size_t index) { shown.points.push_back(samples[index]); });
  shown.is_lit = !given.has_colours;
  shown.spacing = wide_spacing_of(placed.patches) *
                  std::sqrt(static_cast<double>(count) / static_cast<double>(kept));
  return shown;
}

}  // namespace relief

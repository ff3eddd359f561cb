#include "preprocess/noise/remove_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/median.h"
#include "preprocess/noise/noise_level.h"
#include "preprocess/noise/return_bias.h"

namespace relief {
namespace {

// Less noise, in spacings, is less than what rounding heights adds.
constexpr float kLeastInSpacings = 0.05F;
// From this much noise on, in spacings, discs about the points themselves are lopsided, and points
// are moved again: fandisk with noise of one spacing keeps 0.46 and 0.39 of it (rms) after one and
// two rounds, bun_zipper with a quarter 0.096 and 0.097.
constexpr float kMuchInSpacings = 0.4F;
// What is left of noise, about, after the first round.
constexpr float kLeftShare = 0.7F;

/// Noise too small to matter becomes none. Returns whether any is left.
bool drop_small(const std::vector<float>& spacing, std::vector<float>& noise) {
  bool is_left = false;
  for (std::size_t slot = 0; slot < noise.size(); ++slot) {
    if (noise[slot] < kLeastInSpacings * spacing[slot]) noise[slot] = 0.0F;
    is_left = is_left || noise[slot] > 0.0F;
  }
  return is_left;
}

/// Moves the points of discs about themselves; then, where there is much noise, those of discs of
/// the same points about where they are now.
SmoothPoints smooth(const PositionTree& tree, const std::vector<float>& spacing,
                    std::vector<float> noise, Progress& progress) {
  std::vector<glm::dvec3> centres(tree.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) centres[slot] = tree.at(slot);
  const std::uint64_t units = 2 * std::uint64_t{tree.size()};
  progress.begin_stage("remove noise", units);
  SmoothPoints first =
      move_points(find_windows(tree, centres, spacing, noise, progress), noise, progress);

  std::vector<float> left = noise;
  for (std::size_t slot = 0; slot < noise.size(); ++slot)
    if (noise[slot] < kMuchInSpacings * spacing[slot]) noise[slot] = left[slot] = 0.0F;
  for (float& value : left) value *= kLeftShare;
  if (std::ranges::none_of(noise, [](float value) { return value > 0.0F; })) return first;
  progress.begin_stage("remove noise", units);
  SmoothPoints second =
      move_points(find_windows(tree, first.positions, spacing, noise, progress), left, progress);
  for (std::size_t slot = 0; slot < noise.size(); ++slot) {
    if (second.normals[slot] == glm::vec3(0.0F)) continue;
    first.positions[slot] = second.positions[slot];
    first.normals[slot] = second.normals[slot];
  }
  return first;
}

}  // namespace

NoiselessPoints remove_noise(const std::vector<glm::dvec3>& positions,
                             const std::vector<float>& spacing, std::optional<double> given,
                             Progress& progress) {
  const PositionTree tree(positions);
  std::vector<float> spacing_of_slot(tree.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot)
    spacing_of_slot[slot] = spacing[tree.index(slot)];
  progress.begin_stage("measure noise", 0);
  const double largest = std::numeric_limits<float>::max();
  std::vector<float> noise =
      given ? std::vector<float>(tree.size(), static_cast<float>(std::min(*given, largest)))
            : estimate_noise(tree, spacing_of_slot);
  NoiselessPoints result;
  if (noise.empty()) return result;
  result.report.noise = given ? *given : median_of(noise);
  if (progress.cancelled() || !drop_small(spacing_of_slot, noise)) return result;

  SmoothPoints by_slot = smooth(tree, spacing_of_slot, noise, progress);
  progress.begin_stage("remove noise", tree.size());
  return_bias(tree, spacing_of_slot, noise, by_slot, progress);
  for (const glm::vec3& normal : by_slot.normals)
    result.report.moved += normal != glm::vec3(0.0F) ? 1 : 0;
  if (result.report.moved == 0) return result;
  result.smooth.positions.resize(tree.size());
  result.smooth.normals.resize(tree.size());
  for (std::uint32_t slot = 0; slot < tree.size(); ++slot) {
    result.smooth.positions[tree.index(slot)] = by_slot.positions[slot];
    result.smooth.normals[tree.index(slot)] = by_slot.normals[slot];
  }
  return result;
}

}  // namespace relief

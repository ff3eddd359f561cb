#include "preprocess/measure/nearest_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <random>

#include "preprocess/measure/patch_distance.h"

namespace relief {
namespace {

/// Small patches with holes, steep and flat, turned any way, near and far from each other.
std::vector<Patch> random_patches(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Patch> patches(count);
  for (Patch& patch : patches) {
    patch.origin = 10.0 * glm::dvec3(unit(random), unit(random), unit(random));
    patch.axes = glm::mat3_cast(
        glm::normalize(glm::dquat(unit(random), unit(random), unit(random), unit(random))));
    patch.spacing = 0.05 + 0.05 * std::abs(unit(random));
    patch.height_step = patch.spacing / 20.0;
    patch.width = 1 + random() % 6;
    patch.height = 1 + random() % 6;
    const int range = random() % 2 == 0 ? 10 : 2000;  // 2000: 100 times as steep as a cell is wide
    for (std::uint32_t k = 0; k < patch.width * patch.height; ++k)
      patch.heights.push_back(random() % 4 == 0 ? kHole
                                                : static_cast<std::int32_t>(random() % range));
  }
  return patches;
}

TEST(NearestPatch, IsWhatTryingAllFinds) {
  std::mt19937 random(1);
  for (const std::size_t count : {0U, 1U, 5U, 300U}) {
    const std::vector<Patch> patches = random_patches(random, count);
    const NearestPatch nearest(patches);
    std::uniform_real_distribution<double> unit(-12.0, 12.0);
    std::size_t found = 0;
    for (int i = 0; i < 3000; ++i) {
      // Half of them near a patch.
      glm::dvec3 point(unit(random), unit(random), unit(random));
      if (i % 2 == 0 && count > 0) point = patches[random() % count].origin + 0.05 * point;
      for (const double start : {std::numeric_limits<double>::infinity(), 1.0}) {
        double expected = start;
        for (const Patch& patch : patches)
          expected = std::min(expected, distance_to_patch(patch, point).value_or(expected));
        EXPECT_EQ(nearest.distance(point, start), expected);
        found += expected < start ? 1 : 0;
      }
    }
    EXPECT_TRUE(count < 300 || found > 500) << found;
  }
}

}  // namespace
}  // namespace relief

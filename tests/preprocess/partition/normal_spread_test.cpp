// The quick refusal of unions must never contradict the test of all normals.
#include "preprocess/partition/normal_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>
#include <random>

namespace relief {
namespace {

/// Unit normals up to `degrees` from an axis, some of them that far.
std::vector<glm::vec3> cap(glm::vec3 axis, double degrees, std::mt19937& random) {
  axis = glm::normalize(axis);
  const glm::vec3 u = glm::normalize(
      glm::cross(axis, std::abs(axis.x) < 0.6F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0)));
  const glm::vec3 v = glm::cross(axis, u);
  const auto next = [&random] { return static_cast<double>(random()) * 0x1p-32; };
  std::vector<glm::vec3> normals;
  for (int k = 0; k < 300; ++k) {
    const double angle = glm::radians(k % 3 == 0 ? degrees : degrees * std::sqrt(next()));
    const double turn = 2.0 * std::numbers::pi * next();
    normals.push_back(glm::normalize(
        static_cast<float>(std::cos(angle)) * axis +
        static_cast<float>(std::sin(angle)) *
            (static_cast<float>(std::cos(turn)) * u + static_cast<float>(std::sin(turn)) * v)));
  }
  return normals;
}

/// Whether a cone is refused to normals that are two sets, every second one of each.
bool refused(const std::vector<glm::vec3>& normals, double cone_degrees) {
  std::vector<std::uint32_t> halves[2];
  for (std::uint32_t i = 0; i < normals.size(); ++i) halves[i % 2].push_back(i);
  return NormalSpread::exceed(NormalSpread(normals, halves[0]), NormalSpread(normals, halves[1]),
                              std::cos(glm::radians(cone_degrees)));
}

TEST(NormalSpread, RefusesNoConeThatHoldsAll) {
  std::mt19937 random(3);
  for (const double cone : {10.0, 45.0, 75.0, 89.0}) {
    for (int k = 0; k < 40; ++k) {
      const glm::vec3 axis(static_cast<float>(k % 7) - 3.0F, static_cast<float>(k % 5) - 2.0F,
                           1.0F);
      // A thousandth of a degree is more than single precision leaves of the normals.
      EXPECT_FALSE(refused(cap(axis, cone - 1e-3, random), cone)) << cone << ' ' << k;
    }
  }
}

TEST(NormalSpread, RefusesWhatIsClearlyWider) {
  std::mt19937 random(4);
  for (const double cone : {10.0, 45.0, 75.0}) {
    // 64 directions are about 25 degrees apart; the farthest of 100 on the rim is within a few.
    EXPECT_TRUE(refused(cap({1, 2, 3}, cone + 5.0, random), cone)) << cone;
  }
}

TEST(NormalSpread, CanBeUnited) {
  const std::vector<glm::vec3> normals{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  const std::vector<std::uint32_t> first{0};
  const std::vector<std::uint32_t> second{1};
  const std::vector<std::uint32_t> third{2};
  NormalSpread all(normals, first);
  const double cone = std::cos(glm::radians(75.0));
  EXPECT_FALSE(NormalSpread::exceed(all, NormalSpread(normals, second), cone));
  all.add(NormalSpread(normals, third));
  EXPECT_TRUE(NormalSpread::exceed(all, NormalSpread(normals, second), cone));
}

}  // namespace
}  // namespace relief

#include "common/volume/move.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "common/transform.h"
#include "common/volume/spherical_harmonics.h"

namespace relief {
namespace {

constexpr std::size_t kAll = harmonics_of(kMaxHarmonicsDegree);

class Random {
 public:
  double number() { return normal_(engine_); }
  glm::dvec3 direction() { return glm::normalize(glm::dvec3(number(), number(), number())); }
  glm::dmat3 rotation() {
    return glm::mat3_cast(glm::normalize(glm::dquat(number(), number(), number(), number())));
  }

 private:
  std::mt19937 engine_{24};
  std::normal_distribution<double> normal_;
};

GaussianCloud one_gaussian(int degree, Random& random) {
  GaussianCloud cloud;
  cloud.centres = {{1.0F, -2.0F, 3.0F}};
  cloud.scales = {{0.3F, 0.05F, 0.01F}};
  cloud.rotations = {glm::quat(glm::quat_cast(random.rotation()))};
  cloud.opacities = {0.7F};
  cloud.degree = degree;
  for (std::size_t c = 0; c < harmonics_of(degree); ++c)
    cloud.harmonics.emplace_back(random.number(), random.number(), random.number());
  return cloud;
}

/// Of the first Gaussian, without the 0.5.
glm::dvec3 colour_along(const GaussianCloud& cloud, glm::dvec3 direction) {
  std::array<double, kAll> basis{};
  harmonics_basis(direction, cloud.degree, basis);
  glm::dvec3 sum(0.0);
  for (std::size_t c = 0; c < harmonics_of(cloud.degree); ++c)
    sum += basis[c] * glm::dvec3(cloud.harmonics[c]);
  return sum;
}

glm::dmat3 variance(const GaussianCloud& cloud) {
  glm::dmat3 axes = glm::mat3_cast(glm::dquat(cloud.rotations[0]));
  for (glm::length_t a = 0; a < 3; ++a) axes[a] *= static_cast<double>(cloud.scales[0][a]);
  return axes * glm::transpose(axes);
}

void expect_near(const glm::dmat3& a, const glm::dmat3& b, double tolerance) {
  for (glm::length_t c = 0; c < 3; ++c)
    EXPECT_LT(glm::distance(a[c], b[c]), tolerance) << "column " << c;
}

/// All that an orthogonal matrix must do to a Gaussian.
void expect_turned(const glm::dmat3& q, int degree, Random& random) {
  const GaussianCloud before = one_gaussian(degree, random);
  GaussianCloud after = before;
  ASSERT_TRUE(move_gaussians(after, {{4.0, 5.0, 6.0}, q, 2.0}));
  // Coefficients are floats about 1: 25 of them round by 6e-8 each.
  for (int d = 0; d < 20; ++d) {
    const glm::dvec3 direction = random.direction();
    EXPECT_LT(glm::distance(colour_along(after, q * direction), colour_along(before, direction)),
              1e-6)
        << "degree " << degree;
  }
  EXPECT_EQ(after.harmonics[0], before.harmonics[0]) << "a colour without direction stays exact";
  // Quaternions are floats: 4 * 6e-8 of the largest variance, 0.36.
  expect_near(variance(after), 4.0 * q * variance(before) * glm::transpose(q), 1e-6);
  const glm::dvec3 centre = glm::dvec3(4.0, 5.0, 6.0) + 2.0 * (q * glm::dvec3(1.0, -2.0, 3.0));
  EXPECT_LT(glm::distance(glm::dvec3(after.centres[0]), centre), 1e-6);
}

TEST(TurnGaussians, TurnsAllDegrees) {
  Random random;
  for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
    for (int k = 0; k < 10; ++k) expect_turned(random.rotation(), degree, random);
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, 1}}) {
      expect_turned(rotation_about(axis, 90.0), degree, random);
      expect_turned(rotation_about(axis, 180.0), degree, random);
      expect_turned(rotation_about(axis, 1e-7), degree, random);
    }
  }
}

TEST(TurnGaussians, MirrorsAllDegrees) {
  Random random;
  for (int degree = 0; degree <= kMaxHarmonicsDegree; ++degree) {
    expect_turned(glm::dmat3(-1.0), degree, random);
    for (int k = 0; k < 10; ++k) {
      glm::dmat3 mirror = random.rotation();
      mirror[k % 3] *= -1.0;
      expect_turned(mirror, degree, random);
    }
  }
}

TEST(TurnGaussians, EachGaussianByItself) {
  Random random;
  GaussianCloud cloud = one_gaussian(2, random);
  const GaussianCloud other = one_gaussian(2, random);
  cloud.centres.push_back(other.centres[0]);
  cloud.scales.push_back(other.scales[0]);
  cloud.rotations.push_back(other.rotations[0]);
  cloud.opacities.push_back(other.opacities[0]);
  cloud.harmonics.insert(cloud.harmonics.end(), other.harmonics.begin(), other.harmonics.end());
  GaussianCloud alone = other;
  const Transform transform{{}, random.rotation(), 1.0};
  ASSERT_TRUE(move_gaussians(cloud, transform));
  ASSERT_TRUE(move_gaussians(alone, transform));
  for (std::size_t c = 0; c < 9; ++c) EXPECT_EQ(cloud.harmonics[9 + c], alone.harmonics[c]);
  EXPECT_EQ(cloud.rotations[1], alone.rotations[0]);
}

TEST(TurnGaussians, WithoutATurnNothingButPlaceAndSize) {
  Random random;
  const GaussianCloud before = one_gaussian(4, random);
  GaussianCloud after = before;
  ASSERT_TRUE(move_gaussians(after, {{1.0, 1.0, 1.0}, glm::dmat3(1.0), 0.5}));
  EXPECT_EQ(after.harmonics, before.harmonics);
  EXPECT_EQ(after.rotations, before.rotations);
  EXPECT_EQ(after.scales[0], 0.5F * before.scales[0]);
}

TEST(TurnGaussians, RefusesWhatLeavesTheRange) {
  Random random;
  for (const Transform& transform :
       {Transform{{1e39, 0.0, 0.0}, glm::dmat3(1.0), 1.0}, Transform{{}, glm::dmat3(1.0), 1e39},
        Transform{{}, glm::dmat3(1.0), 1e-45}}) {
    GaussianCloud cloud = one_gaussian(0, random);
    const Status moved = move_gaussians(cloud, transform);
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().message,
              "Gaussian 1 leaves the range of single precision; move and scale the scene less");
  }
}

}  // namespace
}  // namespace relief

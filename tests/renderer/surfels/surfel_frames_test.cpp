// Axes and bends of surfels from their neighbours' normals.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "renderer/surfels/surfels.h"
#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief {
namespace {

std::vector<SurfelFrame> must_find(const test::SampledSurface& surface, double radius) {
  const std::vector<double> radii(surface.positions.size(), radius);
  Progress progress;
  auto frames = find_surfel_frames(surface.positions, surface.normals, radii, progress);
  if (frames) return std::move(*frames);
  ADD_FAILURE() << frames.error().message;
  return {};
}

/// The curvature along a direction of the tangent plane.
double curvature(const SurfelFrame& frame, glm::dvec3 along) {
  const double x = glm::dot(along, frame.u);
  const double y = glm::dot(along, frame.v);
  return frame.bend.x * x * x + 2.0 * frame.bend.y * x * y + frame.bend.z * y * y;
}

/// Two planes that meet along y at x = 0, the right one `degrees` down.
test::SampledSurface roof(double degrees) {
  const double angle = degrees * std::acos(-1.0) / 180.0;
  test::SampledSurface surface;
  for (int j = -15; j <= 15; ++j) {
    for (int i = -15; i <= 15; ++i) {
      const double x = 0.1 * (i + 0.5);
      const bool is_right = x > 0.0;
      surface.positions.emplace_back(is_right ? x * std::cos(angle) : x, 0.1 * j,
                                     is_right ? -x * std::sin(angle) : 0.0);
      surface.normals.emplace_back(is_right ? glm::vec3(std::sin(angle), 0, std::cos(angle))
                                            : glm::vec3(0, 0, 1));
    }
  }
  return surface;
}

TEST(SurfelFrames, AreRightHanded) {
  const auto surface = test::sample_surface(test::Shape::Sphere, test::Sampling::Random, 500, 2);
  const auto frames = must_find(surface, 0.1);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    // Normals are floats.
    EXPECT_NEAR(glm::length(frames[k].u), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(frames[k].u, frames[k].v), 0.0, 1e-12);
    EXPECT_LT(glm::distance(glm::cross(frames[k].u, frames[k].v), glm::dvec3(surface.normals[k])),
              1e-6);
  }
}

TEST(SurfelFrames, BendAsTheSurfaceDoes) {
  const auto sphere = test::sample_surface(test::Shape::Sphere, test::Sampling::BlueNoise, 2000, 2);
  for (const SurfelFrame& frame : must_find(sphere, 0.05)) {
    // Curvature 1 downward; the ridge takes at most 0.5 %.
    EXPECT_NEAR(frame.bend.x, -1.0, 0.01);
    EXPECT_NEAR(frame.bend.z, -1.0, 0.01);
    EXPECT_NEAR(frame.bend.y, 0.0, 0.01);
  }
  test::SampledSurface cylinder;  // of radius 2 along z
  for (int k = 0; k < 1200; ++k) {
    const double angle = 0.05 * (k % 120) + 0.025 * (k / 120 % 2);
    cylinder.positions.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle), 0.1 * (k / 120));
    cylinder.normals.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const auto bent = must_find(cylinder, 0.1);
  for (std::size_t k = 0; k < bent.size(); ++k) {
    EXPECT_NEAR(curvature(bent[k], {0, 0, 1}), 0.0, 0.01) << k;
    const glm::dvec3 around = glm::cross(glm::dvec3(0, 0, 1), glm::dvec3(cylinder.normals[k]));
    EXPECT_NEAR(curvature(bent[k], around), -0.5, 0.01) << k;
  }
}

TEST(SurfelFrames, StayFlatBesideCreases) {
  // Beyond 60 degrees neighbours are of another surface; below they are outvoted.
  for (const double degrees : {90.0, 70.0, 45.0}) {
    const auto surface = roof(degrees);
    const auto frames = must_find(surface, 0.07);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (glm::length(surface.positions[k]) > 1.2) continue;  // at the border few neighbours vote
      // The rim of a disc that bends so is off by 0.05 radii at most.
      EXPECT_LT(std::abs(curvature(frames[k], frames[k].u)) * 0.07, 0.1) << degrees << ' ' << k;
      EXPECT_LT(std::abs(curvature(frames[k], frames[k].v)) * 0.07, 0.1) << degrees << ' ' << k;
    }
  }
}

TEST(SurfelFrames, BendLittleByNoise) {
  auto surface = test::sample_surface(test::Shape::Plane, test::Sampling::BlueNoise, 2000, 2);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0F, 0.1F);  // 6 degrees
  for (glm::vec3& n : surface.normals)
    n = glm::normalize(n + glm::vec3(noise(random), noise(random), noise(random)));
  double sum = 0.0;
  for (const SurfelFrame& frame : must_find(surface, 0.05))
    sum += std::abs(frame.bend.x) + std::abs(frame.bend.z);
  // Two slopes of 0.1 over a spacing of 0.05 would bend by 2; means over 16 neighbours bend less,
  // and what fits no better than chance less still.
  EXPECT_LT(sum / 2.0 / static_cast<double>(surface.normals.size()), 0.35);
}

TEST(SurfelFrames, StayWithinTheSurfel) {
  // A sphere of radius 1 by surfels of radius 2.
  const auto sphere = test::sample_surface(test::Shape::Sphere, test::Sampling::Random, 60, 2);
  for (const SurfelFrame& frame : must_find(sphere, 2.0)) {
    for (const glm::dvec3 along : {frame.u, frame.v, (frame.u + frame.v) / std::sqrt(2.0)})
      EXPECT_LE(std::abs(curvature(frame, along)) * 2.0, 1.0 + 1e-9);
  }
}

TEST(SurfelFrames, AreBoundedForAnyInput) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(must_find({}, 1.0).empty());
  test::SampledSurface odd;
  odd.positions.assign(100, glm::dvec3(1, 2, 3));
  odd.normals.assign(100, glm::vec3(0, 0, 1));
  for (std::size_t k = 0; k < 50; ++k) odd.positions.emplace_back(static_cast<double>(k), 0, 0);
  for (std::size_t k = 0; k < 50; ++k)
    odd.normals.emplace_back(k % 3 == 0   ? glm::vec3(kNaN)
                             : k % 3 == 1 ? glm::vec3(0)
                                          : glm::vec3(1));
  for (const double radius :
       {0.0, -1.0, 1.0, 1e-300, 1e300, std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    for (const SurfelFrame& frame : must_find(odd, radius)) {
      ASSERT_NEAR(glm::length(frame.u), 1.0, 1e-9);
      ASSERT_NEAR(glm::length(frame.v), 1.0, 1e-9);
      ASSERT_TRUE(std::isfinite(frame.bend.x + frame.bend.y + frame.bend.z));
    }
  }
  test::SampledSurface two{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 0, 1}}};
  EXPECT_EQ(must_find(two, 1.0).size(), 2U);
}

TEST(SurfelFrames, DoNotDependOnThreads) {
  const auto surface = test::sample_surface(test::Shape::Torus, test::Sampling::Random, 10000, 2);
  const auto many = must_find(surface, 0.03);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const auto one = must_find(surface, 0.03);
  for (std::size_t k = 0; k < one.size(); ++k) ASSERT_EQ(many[k].bend, one[k].bend);
}

}  // namespace
}  // namespace relief

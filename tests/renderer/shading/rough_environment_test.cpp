// What rough mirrors reflect, against integrals over the whole environment.
#include "renderer/shading/environment/rough_environment.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "tests/renderer/shading/environments.h"

namespace relief {
namespace {

using test::environment_of;

/// D(h) (n . l) of a direction at this cosine from the one that is faced, but for a factor.
double weight_at(double cosine, double roughness) {
  if (cosine <= 0.0) return 0.0;
  const double squared = std::pow(roughness, 4.0);
  const double half = 0.5 * (1.0 + cosine);  // the squared cosine of half the angle
  return cosine / std::pow(half * (squared - 1.0) + 1.0, 2.0);
}

/// The mean over every texel, with its solid angle.
glm::dvec3 integrate(const CubeMap& cube, glm::dvec3 direction, double roughness) {
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::uint32_t y = 0; y < cube.size; ++y) {
      for (std::uint32_t x = 0; x < cube.size; ++x) {
        const glm::dvec2 st = (2.0 * glm::dvec2(x, y) + 1.0) / static_cast<double>(cube.size) - 1.0;
        const glm::dvec3 d = cube_direction(face, st);
        const double weight = weight_at(glm::dot(glm::normalize(d), direction), roughness) /
                              std::pow(glm::dot(d, d), 1.5);
        sum += weight * glm::dvec3(cube.faces[face][std::size_t{y} * cube.size + x]);
        weights += weight;
      }
    }
  }
  return sum / weights;
}

TEST(RoughEnvironment, OfOneColourIsThatColour) {
  const CubeMap grey = environment_of(64, [](glm::dvec3) { return glm::vec3(0.25F, 1.0F, 8.0F); });
  for (const double roughness : {0.01, 0.3, 1.0}) {
    const CubeMap rough = prefilter(grey, roughness, 32);
    for (const auto& face : rough.faces) {
      for (const glm::vec3& texel : face) {
        // Up to 1024 weights that add up to 1, in floats.
        EXPECT_LT(glm::distance(texel, glm::vec3(0.25F, 1.0F, 8.0F)), 1e-5F * 8.0F) << roughness;
      }
    }
  }
}

TEST(RoughEnvironment, FlattensAGradientByTheMeanCosine) {
  const CubeMap slope =
      environment_of(64, [](glm::dvec3 d) { return glm::vec3(1.0 + d.y, 1.0 + d.x, 1.0 - d.z); });
  for (const double roughness : {0.2, 0.5, 0.8, 1.0}) {
    double cosines = 0.0;
    double weights = 0.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = (i + 0.5) / kSteps;
      cosines += cosine * weight_at(cosine, roughness);
      weights += weight_at(cosine, roughness);
    }
    const double mean = cosines / weights;
    const CubeMap rough = prefilter(slope, roughness, 32);
    for (const glm::dvec3 d : {glm::dvec3(0, 1, 0), glm::dvec3(0.48, -0.6, 0.64)}) {
      // A few hundred directions, each looked up in an average of some degrees, which flattens the
      // gradient by up to 0.3 %.
      const glm::dvec3 expected(1.0 + mean * d.y, 1.0 + mean * d.x, 1.0 - mean * d.z);
      EXPECT_LT(glm::distance(glm::dvec3(look_up(rough, d)), expected), 0.005) << roughness;
    }
  }
}

TEST(RoughEnvironment, IsTheIntegralOverTheEnvironment) {
  const auto environment = load_environment("");
  ASSERT_TRUE(environment);
  for (const double roughness : {0.25, 0.5, 1.0}) {
    const CubeMap rough = prefilter(*environment, roughness, rough_size(*environment, roughness));
    double squared = 0.0;
    int count = 0;
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0.1, 0.2, 1), glm::dvec3(-1, 1, 1),
                               glm::dvec3(0.3, -1, 0.2), glm::dvec3(-0.7, 0.1, 0.6)}) {
      const glm::dvec3 direction = glm::normalize(d);
      const glm::dvec3 off =
          glm::dvec3(look_up(rough, direction)) - integrate(*environment, direction, roughness);
      squared += glm::dot(off, off) / 3.0;
      ++count;
    }
    // Light is about 0.6; the directions leave a hundredth or so of what varies within the lobe.
    EXPECT_LT(std::sqrt(squared / count), 0.012) << roughness;
  }
}

TEST(RoughEnvironment, IsTheSameForAnyNumberOfThreads) {
  const auto environment = load_environment("");
  ASSERT_TRUE(environment);
  const CubeMap reference = prefilter(*environment, 0.6, 32);
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(prefilter(*environment, 0.6, 32).faces, reference.faces);
  }
}

TEST(RoughEnvironment, HasTheTexelsThatItsLobeNeeds) {
  CubeMap environment;
  environment.size = 512;
  EXPECT_EQ(rough_size(environment, 0.01), 512U);  // no more than there are
  EXPECT_EQ(rough_size(environment, 1.0), 32U);
  // Half the width at half the height is 1.29 * 0.2^2 = 0.052, two texels 2 * 2/128 = 0.031.
  EXPECT_EQ(rough_size(environment, 0.2), 128U);
  environment.size = 2048;
  EXPECT_EQ(rough_size(environment, 0.01), 512U);  // more would take too long
  environment.size = 8;
  EXPECT_EQ(rough_size(environment, 1.0), 8U);
}

}  // namespace
}  // namespace relief

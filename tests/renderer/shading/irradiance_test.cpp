// What surfaces scatter of an environment, against integrals over all of it.
#include "renderer/shading/environment/irradiance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/shading/environment/standing_cube.h"
#include "shaders/include/shading.h"
#include "tests/renderer/shading/environments.h"

namespace relief {
namespace {

using test::environment_of;

glm::vec3 scattered_under(const CubeMap& cube, glm::vec3 normal) {
  shared::Frame frame{};
  set_environment(frame, glm::dmat3(1.0));
  std::ranges::copy(irradiance_of(cube), frame.irradiance);
  return shared::scattered(frame, normal);
}

/// The cosine-weighted mean over the hemisphere.
glm::dvec3 integrate(const CubeMap& cube, glm::dvec3 normal) {
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::uint32_t i = 0; i < cube.size * cube.size; ++i) {
      const glm::dvec2 texel(i % cube.size, i / cube.size);
      const glm::dvec3 d = cube_direction(face, (2.0 * texel + 1.0) / double(cube.size) - 1.0);
      const double weight =
          std::max(glm::dot(glm::normalize(d), normal), 0.0) / std::pow(glm::dot(d, d), 1.5);
      sum += weight * glm::dvec3(cube.faces[face][i]);
      weights += weight;
    }
  }
  return sum / weights;
}

TEST(Irradiance, OfOneColourIsThatColour) {
  const CubeMap grey = environment_of(64, [](glm::dvec3) { return glm::vec3(0.5F, 1, 8); });
  for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0.6F, 0, -0.8F)}) {
    // The middles of texels stand for them: 64 x 64 a face are off by 1e-4.
    EXPECT_LT(glm::distance(scattered_under(grey, n), glm::vec3(0.5F, 1, 8)), 2e-3F);
  }
}

TEST(Irradiance, OfAnyLightIsItsIntegralUpToTheSecondOrder) {
  // A bright cap above, a red one to the right, dim elsewhere.
  const CubeMap sky = environment_of(64, [](glm::dvec3 d) {
    return glm::vec3(0.1F + (d.y > 0.7 ? 4.0F : 0.0F)) + glm::vec3(d.x > 0.8 ? 2.0F : 0.0F, 0, 0);
  });
  for (const glm::dvec3 n : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
                             glm::normalize(glm::dvec3(1, 1, 1))}) {
    const glm::dvec3 wanted = integrate(sky, n);
    // Terms of the fourth order and beyond are missing: for a cap of 45 degrees up to 4 % of the
    // brightest.
    EXPECT_LT(glm::distance(glm::dvec3(scattered_under(sky, glm::vec3(n))), wanted), 0.1)
        << wanted.x << ' ' << wanted.y;
  }
}

TEST(LitByEnvironment, AWhiteSurfaceInWhiteLightIsWhite) {
  shared::Frame frame{};
  set_environment(frame, glm::dmat3(1.0));
  std::ranges::copy(irradiance_of(environment_of(32, [](glm::dvec3) { return glm::vec3(1.0F); })),
                    frame.irradiance);
  for (const float facing : {1.0F, 0.5F, 0.01F}) {
    const glm::vec3 ray(-std::sqrt(1.0F - facing * facing), 0.0F, -facing);
    const glm::vec3 seen = shared::lit_by_environment(frame, glm::vec3(1.0F), glm::vec3(0, 0, 1),
                                                      ray, glm::vec3(1.0F));
    EXPECT_LT(glm::distance(seen, glm::vec3(1.0F)), 2e-3F) << "what is reflected is not scattered";
    const glm::vec3 black = shared::lit_by_environment(frame, glm::vec3(0.0F), glm::vec3(0, 0, 1),
                                                       ray, glm::vec3(1.0F));
    EXPECT_GT(black.x, 0.01F);
    EXPECT_LT(black.x, 0.5F);
  }
}

}  // namespace
}  // namespace relief

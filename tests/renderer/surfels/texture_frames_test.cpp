// How textures lie on surfels.
#include "renderer/surfels/texture_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief {
namespace {

/// Points of a plane, with the coordinates that a function gives them.
struct Textured {
  test::SampledSurface surface =
      test::sample_surface(test::Shape::Plane, test::Sampling::Jittered, 900, 4);
  std::vector<glm::vec2> texcoords;
  std::vector<SurfelFrame> frames;
  std::vector<glm::mat2> gradients;

  template <class Texcoord>
  explicit Textured(const Texcoord& texcoord_at, double radius = 0.06) {
    const std::vector<double> radii(surface.positions.size(), radius);
    for (const glm::dvec3 p : surface.positions) texcoords.push_back(texcoord_at(p));
    Progress progress;
    auto found = find_surfel_frames(surface.positions, surface.normals, radii, progress);
    EXPECT_TRUE(found);
    frames = std::move(*found);
    auto maps = find_texture_gradients(surface.positions, texcoords, frames, radii, progress);
    EXPECT_TRUE(maps);
    gradients = std::move(*maps);
  }

  /// How far the coordinates move for a step in the world.
  [[nodiscard]] glm::vec2 change(std::size_t k, glm::dvec3 step) const {
    return gradients[k] * glm::vec2(glm::dot(step, frames[k].u), glm::dot(step, frames[k].v));
  }
};

glm::vec2 affine(glm::dvec3 p) {
  return {0.3 * p.x - 0.1 * p.y + 0.5, 0.2 * p.x + 0.4 * p.y};
}

void expect_affine(const Textured& textured, std::size_t k) {
  // Coordinates are floats of about 1 at a distance of about 0.07.
  EXPECT_LT(glm::distance(textured.change(k, {1, 0, 0}), glm::vec2(0.3F, 0.2F)), 1e-4F) << k;
  EXPECT_LT(glm::distance(textured.change(k, {0, 1, 0}), glm::vec2(-0.1F, 0.4F)), 1e-4F) << k;
}

TEST(TextureGradients, AreThoseOfAnAffineMap) {
  const Textured textured(affine);
  for (std::size_t k = 0; k < textured.gradients.size(); ++k) expect_affine(textured, k);
}

TEST(TextureGradients, LeaveOutNeighboursBeyondASeam) {
  // A chart of the right half lies elsewhere, turned by a quarter.
  const Textured charts([](glm::dvec3 p) {
    return p.x < 0.013 ? affine(p) : glm::vec2(0.9 - 0.3 * p.y, 0.1 + 0.3 * p.x);
  });
  std::size_t at_seam = 0;
  for (std::size_t k = 0; k < charts.gradients.size(); ++k) {
    const glm::dvec3 p = charts.surface.positions[k];
    if (std::max(std::abs(p.x), std::abs(p.y)) > 1.0) continue;
    at_seam += std::abs(p.x - 0.013) < 0.07 ? 1 : 0;
    if (p.x < 0.013) {
      expect_affine(charts, k);
    } else {
      EXPECT_LT(glm::distance(charts.change(k, {1, 0, 0}), glm::vec2(0.0F, 0.3F)), 1e-4F) << k;
    }
  }
  EXPECT_GT(at_seam, 30U);
  // A texture that begins again.
  const Textured wrapped([](glm::dvec3 p) {
    const glm::vec2 t = affine(p);
    return glm::vec2(t.x - std::floor(t.x), t.y - std::floor(t.y));
  });
  for (std::size_t k = 0; k < wrapped.gradients.size(); ++k) {
    const glm::dvec3 p = wrapped.surface.positions[k];
    if (std::max(std::abs(p.x), std::abs(p.y)) < 1.0) expect_affine(wrapped, k);
  }
}

TEST(TextureGradients, AreZeroWhereNothingIsKnown) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  // Far from all others by its radius; and coordinates that are random to the eye.
  for (const glm::mat2& gradient : Textured(affine, 1e-6).gradients)
    EXPECT_EQ(gradient, glm::mat2(0.0F));
  const Textured bad(
      [](glm::dvec3 p) { return std::abs(p.x) < 0.3 ? glm::vec2(kNaN) : affine(p); });
  for (std::size_t k = 0; k < bad.gradients.size(); ++k) {
    const glm::dvec3 p = bad.surface.positions[k];
    if (std::abs(p.x) < 0.3) {
      EXPECT_EQ(bad.gradients[k], glm::mat2(0.0F));
    } else if (std::max(std::abs(p.x), std::abs(p.y)) < 1.0) {
      expect_affine(bad, k);
    }
  }
  const Textured constant([](glm::dvec3) { return glm::vec2(0.25F); });
  for (const glm::mat2& gradient : constant.gradients) EXPECT_EQ(gradient, glm::mat2(0.0F));
}

}  // namespace
}  // namespace relief

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "preprocess/texture/acquisition/even_sample.h"
#include "preprocess/texture/acquisition/surface_points.h"
#include "tests/preprocess/texture/textures.h"

namespace relief::test {
namespace {

Points square_with_normals() {
  Points mesh = unit_square();
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  return mesh;
}

double nearest_distance(const SurfacePoints& points, std::size_t i) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (j == i) continue;
    nearest = std::min(nearest, glm::distance(points.positions[i], points.positions[j]));
  }
  return nearest;
}

TEST(SurfacePoints, AreaCountsTrianglesOnceAndTexturesAsOftenAsTheyAreUsed) {
  Points mesh = unit_square();
  for (glm::dvec3& p : mesh.positions) p *= 3.0;
  for (glm::vec2& t : mesh.texcoords) t *= 2.0F;
  const SurfaceArea area = area_of(mesh);
  EXPECT_DOUBLE_EQ(area.world, 9.0);
  EXPECT_DOUBLE_EQ(area.texture, 4.0);
}

TEST(SurfacePoints, MeansOverThePointsAreMeansOverTheSurface) {
  const SurfacePoints points = spread_over_triangles(square_with_normals(), 4000);
  ASSERT_EQ(points.size(), 4000U);
  double mean = 0.0;
  for (const glm::dvec3& p : points.positions) mean += p.x * p.x * p.y;
  // Random points would be off by 0.2 / sqrt(4000) = 0.003 on average, these by about 1 / 4000.
  EXPECT_NEAR(mean / 4000.0, 1.0 / 6.0, 5e-4);
}

TEST(SurfacePoints, SmallTrianglesGetTheirShareToo) {
  // 128 x 128 cells of two triangles each, 1.5 points a cell: each quarter has its quarter.
  Points mesh;
  constexpr std::uint32_t kSide = 128;
  for (std::uint32_t j = 0; j <= kSide; ++j) {
    for (std::uint32_t i = 0; i <= kSide; ++i) mesh.positions.emplace_back(i, j, 0);
  }
  mesh.texcoords.assign(mesh.size(), glm::vec2(0.5F));
  mesh.normals.assign(mesh.size(), glm::vec3(0, 0, 1));
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i) {
      const std::uint32_t a = j * (kSide + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + kSide + 2});
      mesh.triangles.push_back({a, a + kSide + 2, a + kSide + 1});
    }
  }
  const std::size_t count = kSide * kSide * 3 / 2;
  const SurfacePoints points = spread_over_triangles(mesh, count);
  ASSERT_EQ(points.size(), count);
  // Their one point is not in the same corner of all of them.
  const auto at_same_position = std::ranges::count_if(points.positions, [&](glm::dvec3 p) {
    return glm::distance(glm::fract(p), glm::fract(points.positions[0])) < 1e-6;
  });
  EXPECT_LE(at_same_position, 2);
  for (const double x : {0.0, kSide / 2.0}) {
    for (const double y : {0.0, kSide / 2.0}) {
      const auto within = std::ranges::count_if(points.positions, [&](glm::dvec3 p) {
        return p.x >= x && p.x < x + kSide / 2.0 && p.y >= y && p.y < y + kSide / 2.0;
      });
      // Each of the quarter's 64 runs of triangles may round by one at both ends.
      EXPECT_NEAR(static_cast<double>(within), static_cast<double>(count) / 4.0, 64.0);
    }
  }
}

TEST(SurfacePoints, InterpolateWithinTheirTriangle) {
  Points mesh = square_with_normals();
  mesh.normals[2] = glm::vec3(1, 0, 0);
  // The second triangle's side of a seam.
  mesh.corner_texcoords = {{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1)},
                           {glm::vec2(5, 5), glm::vec2(6, 6), glm::vec2(5, 6)}};
  const SurfacePoints points = spread_over_triangles(mesh, 1000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec2 at(points.positions[i]);
    const glm::vec2 expected = at.y <= at.x ? at : at + 5.0F;
    // A rounding of floats near 6.
    EXPECT_LT(glm::distance(points.texcoords[i], expected), 2e-6F);
    EXPECT_NEAR(glm::length(points.normals[i]), 1.0F, 1e-6F);
  }
}

TEST(SurfacePoints, DegenerateTrianglesGetNothingAndOppositeNormalsAreNotNan) {
  Points mesh = square_with_normals();
  mesh.normals[0] = glm::vec3(0, 0, -1);
  mesh.normals[3] = glm::vec3(0, 0, -1);
  mesh.triangles.push_back({1, 1, 2});
  mesh.triangles.push_back({0, 0, 0});
  const SurfacePoints points = spread_over_triangles(mesh, 5000);
  ASSERT_EQ(points.size(), 5000U);
  for (const glm::vec3 n : points.normals) EXPECT_NEAR(std::abs(n.z), 1.0F, 1e-6F);
}

TEST(SurfacePoints, UtmSizeCoordinatesKeepTheirDigits) {
  Points mesh = square_with_normals();
  const glm::dvec3 far(500000.0, 4649776.0, 120.0);
  const SurfacePoints near_points = spread_over_triangles(mesh, 100);
  for (glm::dvec3& p : mesh.positions) p += far;
  const SurfacePoints proxy_points = spread_over_triangles(mesh, 100);
  for (std::size_t i = 0; i < 100; ++i) {
    // Doubles near 5e6 are 1e-9 apart.
    EXPECT_LT(glm::distance(proxy_points.positions[i] - far, near_points.positions[i]), 2e-9);
  }
}

TEST(ThinOut, KeepsPointsEvenlyApartAndLeavesNoGap) {
  constexpr std::size_t kCount = 900;
  const SurfacePoints all = spread_over_triangles(square_with_normals(), 4 * kCount);
  const SurfacePoints kept = thin_out(all, kCount, 1.0);
  ASSERT_EQ(kept.size(), kCount);
  const double h = 1.0 / std::sqrt(static_cast<double>(kCount));
  double mean = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double nearest = nearest_distance(kept, i);
    mean += nearest / static_cast<double>(kCount);
    // Random points come as near as 0.02 h; the densest packing has 1.07 h.
    EXPECT_GT(nearest, 0.45 * h);
  }
  // Random points: 0.5 h; a square grid: h.
  EXPECT_GT(mean, 0.75 * h);
  for (double y = 0.0; y <= 1.0; y += h / 4.0) {
    for (double x = 0.0; x <= 1.0; x += h / 4.0) {
      double nearest = 1.0;
      for (const glm::dvec3& p : kept.positions) {
        nearest = std::min(nearest, glm::distance(p, glm::dvec3(x, y, 0.0)));
      }
      // The support of a splat at cutoff 1 reaches 1.41 h: every place is in one.
      EXPECT_LT(nearest, 1.41 * h) << x << ", " << y;
    }
  }
}

TEST(ThinOut, SheetsThatFaceAwayDoNotCrowdEachOther) {
  Points mesh = square_with_normals();
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.positions.push_back(mesh.positions[i] + glm::dvec3(0, 0, -1e-6));
    mesh.texcoords.push_back(mesh.texcoords[i]);
    mesh.normals.emplace_back(0, 0, -1);
  }
  mesh.triangles.push_back({4, 6, 5});
  mesh.triangles.push_back({4, 7, 6});
  const SurfacePoints kept = thin_out(spread_over_triangles(mesh, 3200), 800, 2.0);
  // Points that crowd each other stay 0.45 h apart (above): of 800 on both sheets, 0.016. Two
  // sheets that know nothing of each other have 400 pairs; a disc of 0.008 has one with a chance of
  // 1 in 12.
  std::size_t close_pairs = 0;
  for (const glm::dvec3& p : kept.positions) {
    for (const glm::dvec3& q : kept.positions) {
      if (p.z == 0.0 && q.z < 0.0 && glm::distance(p, q) < 0.008) ++close_pairs;
    }
  }
  EXPECT_GT(close_pairs, 10U);
}

}  // namespace
}  // namespace relief::test

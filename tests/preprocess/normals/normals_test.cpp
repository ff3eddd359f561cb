#include "preprocess/normals/normals.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

struct Completed {
  Points points;
  NormalsReport report;
};

Completed complete(Points points) {
  const NeighbourGraph graph = find_neighbours(points.positions, 16);
  const LocalFrames frames = fit_local_frames(points.positions, graph);
  const NormalsReport report = complete_normals(points, graph, frames);
  return {std::move(points), report};
}

template <class Surface>
double worst_cosine(const Points& points, const Surface& surface) {
  double worst = 1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    worst = std::min(worst,
                     glm::dot(glm::dvec3(points.normals[i]), surface.normal(points.positions[i])));
  }
  return worst;
}

// A plane through 8 neighbours of a surface with kappa times spacing = 0.03 tilts by a degree or
// two where the sampling is lopsided; cos 6 degrees = 0.9945 holds for every point.
constexpr double kSixDegrees = 0.9945;

TEST(Normals, OfASphereAreRadialAndOutward) {
  const Completed done = complete(test::sample_sphere(8000));
  EXPECT_TRUE(done.report.estimated);
  EXPECT_GT(worst_cosine(done.points, test::Sphere{}), kSixDegrees);
}

TEST(Normals, OfATorusPointOutwardInsideTheHole) {
  const test::Torus torus;
  const Completed done = complete(test::sample_torus(torus, 0.02));
  EXPECT_GT(worst_cosine(done.points, torus), kSixDegrees);
}

TEST(Normals, OfAnOpenSaddleAreOfOneSide) {
  const test::Saddle saddle;
  Completed done = complete(test::sample_height_field(
      0.5, 0.02, [&](double x, double y) { return saddle.height(x, y); }));
  // An open sheet has no outside: +Z decides.
  EXPECT_GT(worst_cosine(done.points, saddle), kSixDegrees);
}

TEST(Normals, FaceTheViewpoint) {
  Points points = test::sample_height_field(0.5, 0.02, [](double, double) { return 0.0; });
  points.viewpoint = glm::dvec3(0, 0, -3);
  const Completed done = complete(std::move(points));
  for (const glm::vec3& n : done.points.normals) EXPECT_LT(n.z, -0.99F);
}

TEST(Normals, OfTwoCloseSheetsStayOnTheirSides) {
  // A slab 3 spacings thick: its faces' normals must oppose each other although they are parallel.
  Points points = test::sample_height_field(
      1.0, 0.02, [](double, double) { return 0.03; }, 1);
  const std::size_t upper = points.size();
  for (const glm::dvec3& p : test::sample_height_field(
                                 1.0, 0.02, [](double, double) { return -0.03; }, 2)
                                 .positions) {
    points.positions.push_back(p);
  }
  const Completed done = complete(std::move(points));
  std::size_t of_one_mind = 0;
  for (std::size_t i = 0; i < upper; ++i) {
    if (done.points.normals[i].z * done.points.normals[0].z > 0.0F) ++of_one_mind;
  }
  EXPECT_EQ(of_one_mind, upper);
}

TEST(Normals, GivenOnesAreRepairedAndCounted) {
  Points points = test::sample_sphere(5000);
  for (const glm::dvec3& p : points.positions) points.normals.emplace_back(2.5 * p);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  points.normals[10] = glm::vec3(0.0F);
  points.normals[500] = glm::vec3(nan, 0.0F, 1.0F);
  points.normals[900] = -points.normals[900];
  points.normals[1300] = glm::cross(points.normals[1300], glm::vec3(0.3F, 0.5F, 0.1F));
  const Completed done = complete(std::move(points));
  EXPECT_FALSE(done.report.estimated);
  EXPECT_EQ(done.report.repaired, 4U);
  EXPECT_GT(worst_cosine(done.points, test::Sphere{}), kSixDegrees);
}

// Beside an edge most neighbours of a point may be of the other face, and their plane its own.
TEST(Normals, GivenOnesOfSharpEdgesAreKept) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Points points;
  // A bar: two faces with an edge of 60 degrees, and the two that close it.
  const glm::dvec3 slope(0.5, 0.0, 0.8660254);
  for (int k = 0; k < 6000; ++k) {
    const double along = unit(random);
    const double away = unit(random);
    points.positions.emplace_back(away, along, 0.0);
    points.normals.emplace_back(0.0F, 0.0F, -1.0F);
    points.positions.push_back(away * slope + glm::dvec3(0.0, along, 0.0));
    points.normals.emplace_back(-0.8660254F, 0.0F, 0.5F);
    if (k % 3 != 0) continue;  // ends are less dense
    const double half = away * unit(random);
    points.positions.push_back((away - half) * slope + glm::dvec3(half, k % 2, 0.0));
    points.normals.emplace_back(0.0F, k % 2 == 0 ? -1.0F : 1.0F, 0.0F);
  }
  const std::vector<glm::vec3> given = points.normals;
  const Completed done = complete(std::move(points));
  EXPECT_EQ(done.report.repaired, 0U);
  for (std::size_t i = 0; i < given.size(); ++i)
    EXPECT_GT(glm::dot(given[i], done.points.normals[i]), 0.99999F) << i;
}

TEST(Normals, GivenOnesOfRandomSignAreOriented) {
  Points points = test::sample_sphere(5000);
  std::mt19937 random(7);
  for (const glm::dvec3& p : points.positions) {
    points.normals.emplace_back((random() & 1U) != 0U ? p : -p);
  }
  const Completed done = complete(std::move(points));
  EXPECT_GT(worst_cosine(done.points, test::Sphere{}), kSixDegrees);
  EXPECT_GT(done.report.repaired, 2000U);
  EXPECT_LT(done.report.repaired, 3000U);
}

/// The least z of all normals.
float lowest(const Points& points) {
  float least = 1.0F;
  for (const glm::vec3& n : points.normals) least = std::min(least, n.z);
  return least;
}

// A hollow's middle lies below its rim, so that its outside would be underneath.
TEST(Normals, TerrainsFaceUpHillsAndHollowsAlike) {
  for (const double relief : {0.1, -0.1}) {
    Points points = test::sample_height_field(
        1.0, 0.03, [&](double x, double y) { return relief * std::exp(-2.0 * (x * x + y * y)); });
    EXPECT_GT(lowest(complete(std::move(points)).points), 0.9F) << relief;
  }
}

TEST(Normals, OpenSheetsThatBendFaceOutward) {
  Points points = test::sample_sphere(8000);
  std::erase_if(points.positions, [](const glm::dvec3& p) { return p.z > 0.0; });
  EXPECT_GT(worst_cosine(complete(std::move(points)).points, test::Sphere{}), 0.95);
}

TEST(Normals, GoodGivenOnesAreKeptAsTheyAre) {
  Points points = test::sample_sphere(3000);
  // Bent by 20 degrees, as a bump map would: consistent, so none of our business.
  for (const glm::dvec3& p : points.positions) {
    points.normals.emplace_back(
        glm::normalize(p + 0.36 * glm::normalize(glm::cross(p, glm::dvec3(0.1, 0.9, 0.2)))));
  }
  const std::vector<glm::vec3> given = points.normals;
  const Completed done = complete(std::move(points));
  EXPECT_EQ(done.report.repaired, 0U);
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_GT(glm::dot(given[i], done.points.normals[i]), 0.99999F);
  }
}

TEST(Normals, ComeFromFacesWhereThereAreAny) {
  // A tetrahedron's corner would confuse a plane fit; the winding of a fan over a ridge decides.
  Points points = test::sample_height_field(0.5, 0.1, [](double, double) { return 0.0; });
  const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(points.size())));
  for (std::uint32_t j = 0; j + 1 < side; ++j) {
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t a = j * side + i;
      // Wound clockwise from above: the normals must point down although +Z would be the default.
      points.triangles.push_back({a, a + side, a + 1});
      points.triangles.push_back({a + 1, a + side, a + side + 1});
    }
  }
  const Completed done = complete(std::move(points));
  for (const glm::vec3& n : done.points.normals) EXPECT_LT(n.z, -0.999F);
}

}  // namespace
}  // namespace relief

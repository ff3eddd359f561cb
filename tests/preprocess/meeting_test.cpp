#include "preprocess/meeting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <utility>

#include "preprocess/normals/normals.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

Meeting meeting_of(Points points) {
  const NeighbourGraph graph = find_neighbours(points.positions, kSurfaceNeighbours);
  const LocalFrames frames = fit_local_frames(points.positions, graph);
  complete_normals(points, graph, frames);
  return choose_meeting({points.positions, points.normals, graph.spacing, frames.roughness}, graph);
}

/// Random points on some faces of the cube from 0 to 1.
Points cube(int faces, int points_of_face) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Points points;
  for (int face = 0; face < faces; ++face) {
    const int axis = face % 3;
    for (int k = 0; k < points_of_face; ++k) {
      glm::dvec3 p(unit(random), unit(random), unit(random));
      glm::vec3 normal(0.0F);
      p[axis] = face < 3 ? 0.0 : 1.0;
      normal[axis] = face < 3 ? -1.0F : 1.0F;
      points.positions.push_back(p);
      points.normals.push_back(normal);
    }
  }
  return points;
}

TEST(Meeting, PatchesOfClosedBodiesMeet) {
  for (const double noise : {0.0, 0.003}) {
    Points points = test::sample_sphere(8000);
    std::mt19937 random(1);
    std::normal_distribution<double> gauss(0.0, noise);
    if (noise > 0.0)
      for (glm::dvec3& p : points.positions) p *= 1.0 + gauss(random);
    const Meeting meeting = meeting_of(std::move(points));
    EXPECT_TRUE(meeting.is_closed) << noise;
    EXPECT_TRUE(meeting.creases) << noise;
  }
}

TEST(Meeting, SharpEdgesAreNoBorders) {
  const Meeting meeting = meeting_of(cube(6, 1500));
  EXPECT_TRUE(meeting.is_closed);
  EXPECT_TRUE(meeting.creases);
}

TEST(Meeting, AnOpenBoxMeetsAtItsEdges) {
  // Eight edges and four borders, all as long.
  const Meeting meeting = meeting_of(cube(5, 1500));
  EXPECT_FALSE(meeting.is_closed);
  EXPECT_TRUE(meeting.creases);
}

TEST(Meeting, PatchesOfOpenSheetsOverlap) {
  const Meeting terrain = meeting_of(test::sample_height_field(
      1.0, 0.03, [](double x, double y) { return 0.1 * std::sin(3.0 * x) * y; }));
  EXPECT_FALSE(terrain.is_closed);
  EXPECT_FALSE(terrain.creases);
  ASSERT_TRUE(terrain.border);
  EXPECT_FALSE(terrain.border->empty());
  Points holed = test::sample_sphere(8000);
  std::erase_if(holed.positions, [](const glm::dvec3& p) { return p.z > 0.7; });
  EXPECT_FALSE(meeting_of(std::move(holed)).creases);
}

}  // namespace
}  // namespace relief

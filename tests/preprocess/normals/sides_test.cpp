// Sides of pieces of a surface: their winding numbers, what lies beyond a part, and their
// refinement.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <utility>

#include "common/bounds.h"
#include "preprocess/normals/normals.h"
#include "preprocess/normals/orient_sample.h"
#include "preprocess/normals/refine_sides.h"
#include "preprocess/normals/side_pieces.h"
#include "preprocess/normals/winding_numbers.h"
#include "tests/preprocess/normals/sided_points.h"

namespace relief {
namespace {

/// Bodies with known sides, and their points' neighbours.
struct Bodies : test::SidedPoints {
  NeighbourGraph graph;

  /// A level square about the origin.
  void add_ground(double half, double spacing) {
    const int across = static_cast<int>(2.0 * half / spacing);
    for (int j = 0; j <= across; ++j) {
      for (int i = 0; i <= across; ++i)
        add({i * spacing - half, j * spacing - half, 0.0}, {0.0, 0.0, 1.0});
    }
  }

  void find_graph() { graph = find_neighbours(points.positions, kSurfaceNeighbours); }
};

Bodies ball() {
  Bodies bodies;
  bodies.add_sphere({5, 6, 7}, 1.0, 0.05);
  bodies.find_graph();
  return bodies;
}

/// 25 balls close above a wide ground: 32,000 points, 4,000 of them of balls.
Bodies balls_on_a_ground() {
  Bodies bodies;
  bodies.add_ground(4.2, 0.05);
  for (int k = 0; k < 25; ++k)
    bodies.add_sphere({1.5 * (k % 5) - 3.0, 1.5 * (k / 5) - 3.0, 0.4}, 0.3, 0.05);
  bodies.find_graph();
  return bodies;
}

SidePieces pieces_of(const Bodies& bodies, std::size_t most, std::vector<glm::vec3>& normals) {
  return make_side_pieces(bodies.points, bodies.graph, known_sides(bodies.points, {}),
                          limits_for(bodies.points.size(), most), normals);
}

TEST(WindingNumbers, AreAHalfOnAClosedSurface) {
  const Bodies bodies = ball();
  std::vector<glm::vec3> normals = bodies.sides;
  const SidePieces pieces = pieces_of(bodies, 100, normals);
  const Eigen::VectorXf sides = sides_as(bodies.sides, pieces, bodies.graph, normals);
  const SurfacePlaces places = places_on(pieces.surface, 3);
  const Eigen::VectorXf totals =
      total_winding_numbers(pieces.surface, dipoles_of(pieces.surface), sides, places);
  ASSERT_GT(totals.size(), 100);
  // Areas of points are those of squares as wide as the spacing: 9 % too many on these spirals.
  EXPECT_LT((totals.array() - 0.5F).abs().maxCoeff(), 0.1F);
  const Eigen::VectorXf by_piece = winding_numbers(pieces.surface, places) * sides;
  EXPECT_LT((by_piece - totals).cwiseAbs().maxCoeff(), 1e-5F) << "sums of floats";
}

TEST(WindingNumbers, OfAPartAndOfWhatLiesBeyondAreThoseOfTheWhole) {
  const Bodies bodies = ball();
  const SampledSides whole = orient_sample(bodies.points.positions, {}, Progress());
  EXPECT_EQ(whole.number(), 0.5F);
  Bounds everything = bounds_of(bodies.points.positions);
  everything.min -= 1e-6;  // pieces are floats
  everything.max += 1e-6;
  Bounds right = everything;
  right.min.x = 5.3;
  Bounds left = everything;
  left.max.x = right.min.x;
  const Bounds nothing{glm::dvec3(100.0), glm::dvec3(101.0)};
  const glm::dvec3 centre(5, 6, 6);
  const SurfacePlaces places{{{0, 0, 2}, {1, 0, 1}, {0, 0, 0.5F}, {0, 5, 0}}, {}};
  const auto beyond = [&](const Bounds& box) {
    return whole.winding_numbers_beyond(box, places, centre);
  };
  const Eigen::VectorXf all = beyond(nothing);
  EXPECT_NEAR(all[0], 0.5F, 0.1F);
  EXPECT_NEAR(all[2], 1.0F, 0.1F) << "within it";
  EXPECT_NEAR(all[3], 0.0F, 1e-3F) << "outside";
  // Pieces that the boxes cut are other dipoles.
  EXPECT_LT((beyond(right) + beyond(left) - all).cwiseAbs().maxCoeff(), 0.01F);
  EXPECT_GT(beyond(right).cwiseAbs().maxCoeff(), 0.2F);
  EXPECT_EQ(beyond(everything), Eigen::VectorXf::Zero(4));
}

TEST(Orientation, OfAnOpenGroundHasNumberZero) {
  const Bodies bodies = balls_on_a_ground();
  std::vector<glm::vec3> normals = fit_local_frames(bodies.points.positions, bodies.graph).normals;
  EXPECT_EQ(orient_normals(bodies.points, bodies.graph, {}, normals, Progress()), 0.0F);
  EXPECT_EQ(bodies.flipped(normals), 0.0);
}

class RefinedSides : public testing::Test {
 protected:
  /// Turns every third ball inside out, and a strip of the ground.
  RefinedSides() : bodies_(balls_on_a_ground()), normals_(bodies_.sides) {
    for (std::size_t i = 0; i < normals_.size(); ++i) {
      const glm::dvec3 p = bodies_.points.positions[i];
      const int ball = static_cast<int>(std::lround(p.x / 1.5) + 5 * std::lround(p.y / 1.5)) + 12;
      if (p.z > 0.05 ? ball % 3 == 0 : p.x > 3.9) normals_[i] = -normals_[i];
    }
  }

  void refine(float number) {
    refine_sides(bodies_.points, bodies_.graph, known_sides(bodies_.points, {}), number, normals_,
                 Progress());
  }

  Bodies bodies_;
  std::vector<glm::vec3> normals_;
};

TEST_F(RefinedSides, AreThoseOfEachBody) {
  EXPECT_GT(bodies_.flipped(normals_), 0.05);
  refine(0.0F);
  EXPECT_EQ(bodies_.flipped(normals_), 0.0);
}

TEST_F(RefinedSides, DoNotDependOnThreads) {
  const std::vector<glm::vec3> before = normals_;
  refine(0.0F);
  const std::vector<glm::vec3> after = std::exchange(normals_, before);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  refine(0.0F);
  EXPECT_EQ(normals_, after);
}

TEST_F(RefinedSides, StayWhereTheyFit) {
  normals_ = bodies_.sides;
  refine(0.0F);
  EXPECT_EQ(bodies_.flipped(normals_), 0.0);
}

}  // namespace
}  // namespace relief

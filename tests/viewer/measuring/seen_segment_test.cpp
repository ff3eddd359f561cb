// Lines of the world in an image.
#include "viewer/measuring/seen_segment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "viewer/navigation/projection.h"

namespace relief {
namespace {

constexpr glm::dvec2 kSize(640.0, 480.0);

/// Looks along -z from (0, 0, 10).
Camera camera() {
  Camera made;
  made.eye = {0.0, 0.0, 10.0};
  return made;
}

TEST(SeenSegment, GoesFromEndToEnd) {
  const auto seen = seen_segment(camera(), {-1.0, 0.5, 0.0}, {1.0, -0.5, 2.0}, kSize, 0.0);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->from, *project(camera(), {-1.0, 0.5, 0.0}, kSize));
  // The part of the line is computed from its start: rounding of a pixel's coordinate.
  EXPECT_LT(glm::distance(seen->to, *project(camera(), {1.0, -0.5, 2.0}, kSize)), 1e-12 * 640.0);
}

TEST(SeenSegment, IsCutWhereItGoesBehindTheEye) {
  for (const bool is_swapped : {false, true}) {
    const glm::dvec3 front(0.0, 1.0, 0.0);
    const glm::dvec3 behind(0.0, 1.0, 20.0);
    const auto seen = is_swapped ? seen_segment(camera(), behind, front, kSize, 10.0)
                                 : seen_segment(camera(), front, behind, kSize, 10.0);
    ASSERT_TRUE(seen);
    const glm::dvec2 low = is_swapped ? seen->to : seen->from;
    const glm::dvec2 high = is_swapped ? seen->from : seen->to;
    EXPECT_NEAR(low.y, project(camera(), front, kSize)->y, 1e-9);
    EXPECT_NEAR(high.y, -10.0, 1e-6) << "upward out of the image, up to the margin";
    EXPECT_NEAR(high.x, 320.0, 1e-6);
  }
}

TEST(SeenSegment, IsNotThereBehindTheEyeOrBesideTheImage) {
  EXPECT_FALSE(seen_segment(camera(), {0.0, 0.0, 11.0}, {1.0, 0.0, 20.0}, kSize, 10.0));
  EXPECT_FALSE(seen_segment(camera(), {0.0, 0.0, 10.0}, {1.0, 0.0, 10.0}, kSize, 10.0));
  EXPECT_FALSE(seen_segment(camera(), {100.0, 0.0, 0.0}, {100.0, 1.0, 0.0}, kSize, 10.0));
}

TEST(SeenSegment, ArcsAndCornersOfMeasurements) {
  const glm::dvec3 corner(5.0e5, 5.0e6, 10.0);
  const auto arc =
      angle_arc(corner + glm::dvec3(3.0, 0.0, 0.0), corner, corner + glm::dvec3(0.0, 6.0, 0.0));
  ASSERT_GT(arc.size(), 10U);
  // Coordinates of 5e6 are 1e-9 apart.
  for (const glm::dvec3 point : arc) EXPECT_NEAR(glm::distance(point, corner), 1.0, 4e-9);
  EXPECT_LT(glm::distance(arc.front(), corner + glm::dvec3(1.0, 0.0, 0.0)), 4e-9);
  EXPECT_LT(glm::distance(arc.back(), corner + glm::dvec3(0.0, 1.0, 0.0)), 4e-9);
  EXPECT_TRUE(angle_arc(corner, corner, corner + 1.0).empty());
  EXPECT_EQ(height_corner({1.0, 2.0, 3.0}, {4.0, 5.0, 7.0}, {0.0, 0.0, 2.0}),
            glm::dvec3(1.0, 2.0, 7.0));
}

}  // namespace
}  // namespace relief

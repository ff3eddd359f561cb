#include "renderer/clip/lines/partner_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <vector>

namespace relief {
namespace {

/// The line on which `edge` lies, that clips what is beyond it in a direction.
PlaneLine line_through(glm::dvec2 edge, glm::dvec2 direction) {
  direction = glm::normalize(direction);
  return {direction, glm::dot(edge, direction), edge, 0};
}

bool clips(const PartnerSets& sets, glm::dvec2 at) {
  return std::ranges::any_of(sets.groups, [&](const LineGroup& group) {
    return std::ranges::all_of(
        group, [&](const PlaneLine& line) { return glm::dot(at, line.direction) > line.offset; });
  });
}

// A rim's two tangents are intersected, and a wall with one of them. It must not take from the
// other what lies far from it.
TEST(PartnerSets, ALineIsIntersectedOnlyWithThoseThatCutIt) {
  const std::array<PlaneLine, 3> lines{line_through({0.2, 0.0}, {1.0, 0.0}),
                                       line_through({0.3, -0.1625}, {0.6, 0.8}),
                                       line_through({0.25, -0.1}, {0.0, -1.0})};
  const PartnerSets sets = group_lines(lines, 0.02);
  EXPECT_EQ(sets.kind, ClipKind::Mixed);
  EXPECT_TRUE(clips(sets, {0.4, 0.2}));     // beyond the tangents, before the wall
  EXPECT_FALSE(clips(sets, {0.25, -0.4}));  // before the second tangent alone
  EXPECT_FALSE(clips(sets, {0.0, 0.0}));
}

TEST(PartnerSets, ManyLinkedLinesTakeBoundedTime) {
  // Tangents of a circle that the centre lies outside of, and as many that contradict them.
  std::vector<PlaneLine> lines;
  for (int k = 0; k < 128; ++k) {
    const double angle = -1.2 + 2.4 * k / 128;
    const glm::dvec2 away(std::cos(angle), std::sin(angle));
    lines.push_back(line_through(glm::dvec2(1.1, 0.0) - away, away));
    lines.push_back(line_through(glm::dvec2(-0.5, 0.3) + 0.4 * away, -away));
  }
  const PartnerSets sets = group_lines(lines, 0.0);
  EXPECT_LE(sets.groups.size(), 4U) << "with a group for each there are 23";
  EXPECT_FALSE(clips(sets, {0.0, 0.0}));
}

}  // namespace
}  // namespace relief

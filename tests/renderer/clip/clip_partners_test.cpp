#include "renderer/clip/clip_partners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/clip/wicke.h"

namespace relief {
namespace {

void add_disc(SplatDiscs& discs, glm::dvec3 centre, glm::dvec3 normal, double radius = 1.0) {
  discs.centres.push_back(centre);
  discs.normals.push_back(glm::normalize(normal));
  discs.radii.push_back(radius);
}

ClipPartners clipped(const SplatDiscs& discs, ClipRule rule = ClipRule::Partners,
                     ClipNormals normals = ClipNormals::Given) {
  Progress progress;
  auto result = find_clip_partners(discs, {rule, {}, normals}, progress);
  EXPECT_TRUE(result);
  EXPECT_EQ(result->first.size(), discs.centres.size() + 1);
  EXPECT_EQ(result->kinds.size(), discs.centres.size());
  EXPECT_EQ(result->first.back(), result->lines.size());
  return *std::move(result);
}

/// The top of an edge at x = 0 and its side.
SplatDiscs edge() {
  SplatDiscs discs;
  add_disc(discs, {-0.5, 0, 0}, {0, 0, 1});
  add_disc(discs, {0, 0, -0.5}, {1, 0, 0});
  return discs;
}

/// A plate's splat at the origin, and splats on a round wall about (0, 1.2, 0) of radius 1, above
/// or below the plate, whose normals point away from the axis or to it.
SplatDiscs round_wall(bool above, bool outward) {
  SplatDiscs discs;
  add_disc(discs, {0, 0, 0}, {0, 0, 1});
  for (const double angle : {-0.7, -0.35, 0.0, 0.35, 0.7}) {
    const glm::dvec3 away(std::sin(angle), -std::cos(angle), 0);
    add_disc(discs, glm::dvec3(0, 1.2, above ? 0.3 : -0.3) + away, outward ? away : -away);
  }
  // Neighbours on the plate, from which the noise is measured; too far from the wall to cross it.
  for (const double x : {-1.2, -0.4, 0.4, 1.2}) add_disc(discs, {x, -1.0, 0}, {0, 0, 1});
  return discs;
}

TEST(ClipPartners, ClipsBothSidesOfAConvexEdge) {
  const ClipPartners result = clipped(edge());
  ASSERT_EQ(result.of(0).size(), 1U);
  ASSERT_EQ(result.of(1).size(), 1U);
  EXPECT_FALSE(is_clipped(result.of(0), {0.49F, 0, 0}));
  EXPECT_TRUE(is_clipped(result.of(0), {0.51F, 0, 0}));
  EXPECT_FALSE(is_clipped(result.of(1), {0, 0, 0.49F}));
  EXPECT_TRUE(is_clipped(result.of(1), {0, 0, 0.51F}));
  EXPECT_EQ(result.kinds[0], ClipKind::Flat);
  EXPECT_EQ(result.counts.partners, 2U);
}

TEST(ClipPartners, DiscsThatDoNotCrossAreNoPartners) {
  // Both meet the line x = z = 0, at places that are apart (Figure 2a).
  SplatDiscs discs;
  add_disc(discs, {-0.9, -0.6, 0}, {0, 0, 1});
  add_disc(discs, {0, 0.6, -0.9}, {1, 0, 0});
  EXPECT_TRUE(clipped(discs).lines.empty());
}

TEST(ClipPartners, EllipsesReachAsFarAsTheirAxes) {
  SplatDiscs discs = edge();
  discs.major_axes = {{0, 1, 0}, {0, 1, 0}};
  // 0.5 away from the edge: ellipses that are 0.4 wide across it do not reach it.
  discs.minor_radii = {0.4, 0.4};
  EXPECT_TRUE(clipped(discs).lines.empty());
  discs.minor_radii = {0.6, 0.6};
  EXPECT_EQ(clipped(discs).lines.size(), 2U);
  discs.minor_radii = {0.6, 0.4};
  EXPECT_TRUE(clipped(discs).lines.empty());
}

TEST(ClipPartners, ThinWallsHaveNoEdge) {
  SplatDiscs discs;
  add_disc(discs, {0, 0, 0.01}, {0.05, 0, 1});
  add_disc(discs, {0, 0, -0.01}, {0.05, 0, -1});
  EXPECT_TRUE(clipped(discs).lines.empty());
}

// The four cells of Figure 5.
TEST(ClipPartners, IntersectsAtAPegAndAtAHolesRim) {
  for (const bool above : {true, false}) {
    // A peg is above and its normals point outward; a hole is below and they point inward.
    const SplatDiscs discs = round_wall(above, above);
    const ClipPartners result = clipped(discs);
    EXPECT_EQ(result.kinds[0], ClipKind::Intersection) << above;
    // Inside the circle, and beside it where one line alone would clip.
    EXPECT_TRUE(is_clipped(result.of(0), {0, 0.4F, 0}));
    EXPECT_FALSE(is_clipped(result.of(0), {0.9F, 0.4F, 0}));
    EXPECT_TRUE(is_clipped(clipped(discs, ClipRule::Independent).of(0), {0.9F, 0.4F, 0}));
  }
}

TEST(ClipPartners, UnitesAtACapAndAtAHolesBottom) {
  for (const bool above : {true, false}) {
    // The centre is inside the circle here: a bottom's walls are above it and face inward.
    SplatDiscs discs = round_wall(above, !above);
    discs.centres[0] = {0, 0.4, 0};
    const ClipPartners result = clipped(discs);
    EXPECT_EQ(result.kinds[0], ClipKind::Union) << above;
    EXPECT_FALSE(is_clipped(result.of(0), {0, 0, 0}));
    EXPECT_TRUE(is_clipped(result.of(0), {0, -0.25F, 0}));
    EXPECT_TRUE(is_clipped(result.of(0), {0.95F, 0.1F, 0}));
  }
}

TEST(ClipPartners, ACornerIsClippedByBothSides) {
  SplatDiscs discs;
  add_disc(discs, {-0.3, -0.3, 0}, {0, 0, 1});
  add_disc(discs, {0, -0.3, -0.3}, {1, 0, 0});
  add_disc(discs, {-0.3, 0, -0.3}, {0, 1, 0});
  const ClipPartners all = clipped(discs);
  EXPECT_EQ(all.of(0).size(), 2U);
  EXPECT_EQ(clipped(discs, ClipRule::Nearest).of(0).size(), 1U);
  EXPECT_TRUE(is_clipped(all.of(0), {0.4F, 0, 0}));
  EXPECT_TRUE(is_clipped(all.of(0), {0, 0.4F, 0}));
}

// A wall that bends away: beyond the bend its splat sees caps of the same rim.
TEST(ClipPartners, DistantPartnersDoNotTurnABentEdge) {
  SplatDiscs discs;
  const glm::dvec3 wall = glm::normalize(glm::dvec3(0.48, 0.87, 0.0));
  add_disc(discs, {-0.203, -0.367, 1.9996}, wall, 0.149);
  add_disc(discs, {-0.192, -0.379, 2.0}, {0, 0, 1}, 0.07);
  add_disc(discs, {-0.189, -0.418, 2.0}, {0, 0, 1}, 0.048);
  add_disc(discs, {-0.116, -0.422, 2.0}, {0, 0, 1}, 0.044);
  add_disc(discs, {-0.066, -0.436, 2.0}, {0, 0, 1}, 0.046);
  add_disc(discs, {0.016, -0.431, 2.0}, {0, 0, 1}, 0.148);
  const ClipPartners result = clipped(discs);
  EXPECT_TRUE(is_clipped(result.of(0), {0, 0, 0.1F}));
  EXPECT_FALSE(is_clipped(result.of(0), {0, 0, -0.1F}));
}

/// Rows of splats on the faces of a pyramid with its tip at the origin, `slope` radians from level.
SplatDiscs tip(int faces, double slope) {
  constexpr double kSpacing = 0.1;
  const double half = std::numbers::pi / faces;
  SplatDiscs discs;
  for (int face = 0; face < faces; ++face) {
    const double a = 2.0 * half * face;
    const glm::dvec3 across(-std::sin(a), std::cos(a), 0.0);
    const glm::dvec3 down(std::cos(a) * std::cos(slope), std::sin(a) * std::cos(slope),
                          -std::sin(slope));
    for (double d = 0.6 * kSpacing; d < 1.0; d += kSpacing) {
      // In even rows, half a spacing from the edges.
      const double width = d * std::cos(slope) * std::tan(half);
      const int count = std::max(1, static_cast<int>(std::lround(2.0 * width / kSpacing)));
      for (int k = 0; k < count; ++k)
        add_disc(discs, d * down + ((2.0 * k + 1.0) / count - 1.0) * width * across,
                 glm::cross(across, down) * -1.0, 1.2 * kSpacing);
    }
  }
  return discs;
}

/// A point of a disc's rim, relative to its centre.
glm::dvec3 on_rim(const SplatDiscs& discs, std::size_t s, double angle) {
  const glm::dvec3 x = glm::normalize(glm::cross(discs.normals[s], glm::dvec3(0.3, 0.5, 0.8)));
  const glm::dvec3 y = glm::cross(discs.normals[s], x);
  return discs.radii[s] * (std::cos(angle) * x + std::sin(angle) * y);
}

// Near the tip a disc's neighbours are mostly of other faces, which is no noise.
TEST(ClipPartners, ATipOfFiveFacesIsClipped) {
  const SplatDiscs discs = tip(5, 1.0);
  const ClipPartners result = clipped(discs);
  for (std::size_t s = 0; s < discs.centres.size(); ++s) {
    if (glm::length(discs.centres[s]) > 0.2) continue;
    for (int k = 0; k < 360; k += 5) {
      const glm::dvec3 offset = on_rim(discs, s, k * std::numbers::pi / 180.0);
      double above = 0.0;  // the planes of all faces go through the tip
      for (const glm::dvec3& normal : discs.normals)
        above = std::max(above, glm::dot(discs.centres[s] + offset, normal));
      EXPECT_TRUE(above < 0.02 || is_clipped(result.of(s), glm::vec3(offset))) << s << ", " << k;
    }
  }
}

// Beyond a corner a cap lies before the wall, whose splat lies below the cap, but not by much.
TEST(ClipPartners, DiscsThatContradictEachOtherAreNoPartners) {
  SplatDiscs discs;
  add_disc(discs, {0, 0, -0.02}, {1, 0, 0});
  add_disc(discs, {0.5, 0, 0}, {0, 0, 1});
  // Flat faces, so that there is no noise that would excuse it.
  for (const double y : {-0.9, -0.6, 0.6, 0.9}) {
    add_disc(discs, {0, y, -0.5}, {1, 0, 0}, 0.3);
    add_disc(discs, {0.9, y, 0}, {0, 0, 1}, 0.3);
  }
  EXPECT_TRUE(clipped(discs).of(0).empty());
}

TEST(ClipPartners, WickesRuleTakesTheTwoNearest) {
  const SplatDiscs discs = round_wall(true, true);
  const ClipPartners result = clipped(discs, ClipRule::Wicke);
  ASSERT_EQ(result.planes.size(), result.lines.size());
  EXPECT_TRUE(wicke_clips(result.of(0), result.planes_of(0), {0, 0.4F, 0}));
  EXPECT_FALSE(wicke_clips(result.of(0), result.planes_of(0), {0.9F, 0.3F, 0}));
  EXPECT_FALSE(wicke_clips({}, {}, {0, 0, 0}));
}

TEST(ClipPartners, LinesThatBoundNothingAreDropped) {
  // Two more splats of the same side: their lines are the same.
  SplatDiscs discs = edge();
  add_disc(discs, {0, 0.2, -0.4}, {1, 0, 0});
  add_disc(discs, {0, -0.2, -0.4}, {1, 0, 0});
  const ClipPartners result = clipped(discs);
  EXPECT_EQ(result.of(0).size(), 1U);
  EXPECT_EQ(clipped(discs, ClipRule::Independent).of(0).size(), 1U);
  EXPECT_EQ(result.counts.partners, 6U);
}

TEST(ClipPartners, ASmoothBallHasNone) {
  // A spiral of 1000 points; radii of 1.2 spacings.
  SplatDiscs discs;
  for (int k = 0; k < 1000; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / 1000.0;
    const double across = std::sqrt(1.0 - z * z);
    const glm::dvec3 p(across * std::cos(2.39996 * k), across * std::sin(2.39996 * k), z);
    add_disc(discs, p, p, 0.13);
  }
  EXPECT_EQ(clipped(discs).counts.partners, 0U);
}

TEST(ClipPartners, RefittedNormalsFindAnEdgeThatNormalsRoundOff) {
  // Normals near the edge at x = 0 are means of both sides', as those of a plane fit.
  SplatDiscs discs;
  for (int side = 0; side < 2; ++side) {
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        const double away = 0.1 * i + 0.05;
        const double other = std::max(0.0, 0.35 - away);
        const glm::dvec3 p(-away, 0.1 * j, 0);
        const glm::dvec3 n(other, 0, 1.0 - other);
        add_disc(discs, side == 0 ? p : glm::dvec3(0, p.y, -away),
                 side == 0 ? n : glm::dvec3(n.z, 0, n.x), 0.15);
      }
    }
  }
  EXPECT_GT(clipped(discs, ClipRule::Partners, ClipNormals::Refit).counts.partners,
            40U + clipped(discs).counts.partners);
}

// Bad input: nothing crashes, every centre stays, discs without a place have no lines.
TEST(ClipPartners, TakesDiscsWithoutPlaceNormalOrArea) {
  SplatDiscs discs = edge();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  add_disc(discs, {nan, 0, 0}, {0, 1, 0});
  add_disc(discs, {0, 0, 0}, {0, 1, 0}, 0.0);
  add_disc(discs, {0, 0, 0}, {0, 1, 0}, -1.0);
  add_disc(discs, {0, 0, 0}, {0, 1, 0}, nan);
  add_disc(discs, {0, 0, 0}, {0, 1, 0});
  discs.normals.back() = glm::dvec3(0.0);
  add_disc(discs, {0, 0, 0}, {0, 1, 0});
  discs.normals.back() = glm::dvec3(nan);
  const ClipPartners result = clipped(discs);
  EXPECT_EQ(result.lines.size(), 2U);
  EXPECT_TRUE(clipped({}).lines.empty());
}

TEST(ClipPartners, BoundsCoincidentDiscsOfAllDirections) {
  // 600 discs at one place: every pair is an edge, and each splat keeps 256 of them.
  SplatDiscs discs;
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < 600; ++k)
    add_disc(discs, {0, 0, 0}, {gauss(random), gauss(random), gauss(random)});
  const ClipPartners result = clipped(discs);
  EXPECT_EQ(result.counts.cut, 600U);
  EXPECT_LE(result.counts.partners, 600U * 256U);
  for (std::size_t s = 0; s < discs.centres.size(); ++s)
    ASSERT_FALSE(is_clipped(result.of(s), {0, 0, 0})) << s;
}

TEST(ClipPartners, PartnersAreSymmetricAndCentresStay) {
  // Noise that makes everything an edge. The rule `independent` drops lines, so those of Wicke's
  // rule, which keeps all, are compared.
  SplatDiscs discs;
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 2000; ++k)
    add_disc(discs, {unit(random), unit(random), 0.0},
             {gauss(random), gauss(random), gauss(random)}, 0.02 + 0.08 * unit(random));
  const ClipPartners all = clipped(discs, ClipRule::Wicke);
  ASSERT_GT(all.lines.size(), 1000U);
  for (std::uint32_t s = 0; s < discs.centres.size(); ++s) {
    for (const ClipLine& line : all.of(s)) {
      const auto others = all.of(line.partner);
      ASSERT_TRUE(std::any_of(others.begin(), others.end(),
                              [&](const ClipLine& other) { return other.partner == s; }));
    }
  }
  for (const ClipRule rule : {ClipRule::Partners, ClipRule::Nearest, ClipRule::Independent}) {
    const ClipPartners result = clipped(discs, rule);
    for (std::size_t s = 0; s < discs.centres.size(); ++s)
      ASSERT_FALSE(is_clipped(result.of(s), {0, 0, 0})) << s;
  }
}

TEST(ClipPartners, StopsWhenInterrupted) {
  class Interrupted final : public Progress {
   public:
    [[nodiscard]] bool cancelled() const override { return true; }
  };
  Interrupted progress;
  const auto result = find_clip_partners(edge(), {ClipRule::Partners, {}, {}}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "interrupted");
}

}  // namespace
}  // namespace relief

// Where patches end between their samples and holes.
#include "renderer/geometry/cells/patch_border.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "shaders/include/shared.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

/// A patch of square cells whose nodes are samples where `inside` says so.
Patch patch_inside(std::uint32_t side, const std::function<bool(double, double)>& inside) {
  Patch patch = test::height_field(side, [](double, double) { return 0.0; }).patches[0];
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i) {
      if (!inside(i, j)) patch.heights[std::size_t{j} * side + i] = kHole;
    }
  }
  return patch;
}

struct CutCell {
  glm::i32vec2 cell;
  BorderPolygon polygon;
};

std::vector<CutCell> pieces_of(const Patch& patch) {
  const PatchBorder border(patch);
  std::vector<CutCell> pieces;
  const glm::i32vec2 end(patch.width, patch.height);
  for (glm::i32vec2 cell(-1); cell.y < end.y; ++cell.y) {
    for (cell.x = -1; cell.x < end.x; ++cell.x) {
      border.for_each_polygon(cell, [&](const BorderPolygon& polygon) {
        pieces.push_back({cell, polygon});
      });
    }
  }
  return pieces;
}

/// Positions on the border curve, which has no samples.
std::vector<glm::dvec3> curve_of(const Patch& patch) {
  const PatchBorder border(patch);
  std::vector<glm::dvec3> curve;
  for (const CutCell& piece : pieces_of(patch)) {
    for (std::uint32_t c = 0; c < piece.polygon.count; ++c) {
      const BorderCorner& corner = piece.polygon.corners[c];
      if (corner.toward != corner.node) curve.push_back(border.position_of(corner));
    }
  }
  return curve;
}

double twice_area(const PatchBorder& border, const BorderPolygon& polygon) {
  double sum = 0.0;
  for (std::uint32_t c = 0; c < polygon.count; ++c) {
    const glm::dvec3 a = border.position_of(polygon.corners[c]);
    const glm::dvec3 b = border.position_of(polygon.corners[(c + 1) % polygon.count]);
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

TEST(PatchBorder, LiesHalfWayBesideStraightRows) {
  const Patch patch = patch_inside(20, [](double x, double) { return x <= 9.0; });
  std::size_t beside = 0;
  for (const glm::dvec3& p : curve_of(patch)) {
    if (p.x < 9.0 || p.y < 4.0 || p.y > 15.0) continue;
    EXPECT_NEAR(p.x, 9.5, shared::kBorderStep);
    ++beside;
  }
  EXPECT_GE(beside, 12U);
}

TEST(PatchBorder, HasNoStepsOfLeaningLinesAndCircles) {
  // A node is a sample if it lies before the line: by marching squares on what is sample and hole
  // alone, border positions would be up to 0.7 cells from it.
  for (const double angle : {0.1, 0.3, 0.5, 0.7}) {
    const glm::dvec2 n(std::cos(angle), std::sin(angle));
    const Patch patch =
        patch_inside(40, [&](double x, double y) { return n.x * x + n.y * y < 25.2; });
    for (const glm::dvec3& p : curve_of(patch)) {
      if (p.x < 4.0 || p.y < 4.0 || p.x > 35.0 || p.y > 35.0) continue;
      EXPECT_NEAR(n.x * p.x + n.y * p.y, 25.2, 0.35) << angle;
    }
  }
  const glm::dvec2 middle(20.3, 19.6);
  const Patch disc = patch_inside(
      41, [&](double x, double y) { return glm::distance(glm::dvec2(x, y), middle) < 15.4; });
  double sum = 0.0;
  double squares = 0.0;
  const std::vector<glm::dvec3> curve = curve_of(disc);
  for (const glm::dvec3& p : curve) {
    const double off = glm::distance(glm::dvec2(p), middle) - 15.4;
    // Farthest where some ten samples of a row end alike, as the circle does not.
    EXPECT_LT(std::abs(off), 0.51);
    sum += off;
    squares += off * off;
  }
  const auto count = static_cast<double>(curve.size());
  // Half-way between samples and holes the steps alone are 0.3 cells (rms).
  EXPECT_LT(std::abs(sum / count), 0.1);
  EXPECT_LT(std::sqrt(squares / count), 0.17);
}

TEST(PatchBorder, PolygonsFillTheirCellsWithoutOverlap) {
  const glm::dvec2 middle(20.3, 19.6);
  const Patch disc = patch_inside(
      41, [&](double x, double y) { return glm::distance(glm::dvec2(x, y), middle) < 15.4; });
  const PatchBorder border(disc);
  double area = 0.0;
  for (const CutCell& piece : pieces_of(disc)) {
    const double own = 0.5 * twice_area(border, piece.polygon);
    EXPECT_GT(own, 0.0) << "counterclockwise";
    EXPECT_LE(own, 1.0);
    area += own;
    EXPECT_GE(piece.polygon.count, 3U);
  }
  for (std::int32_t j = 0; j < 40; ++j) {
    for (std::int32_t i = 0; i < 40; ++i) {
      const bool whole = border.is_sample({i, j}) && border.is_sample({i + 1, j}) &&
                         border.is_sample({i, j + 1}) && border.is_sample({i + 1, j + 1});
      area += whole ? 1.0 : 0.0;
    }
  }
  // 100 border positions that are off by 0.17 cells at random and up to 0.1 alike.
  EXPECT_NEAR(area, std::numbers::pi * 15.4 * 15.4, 0.1 * 2.0 * std::numbers::pi * 15.4);
}

TEST(PatchBorder, SamplesThatTouchAtACornerStayApart) {
  const Patch patch = patch_inside(10, [](double x, double y) { return (x < 5) == (y < 5); });
  std::size_t at_corner = 0;
  for (const CutCell& piece : pieces_of(patch)) {
    if (piece.cell != glm::i32vec2(4, 4)) continue;
    ++at_corner;
    EXPECT_EQ(piece.polygon.count, 3U);
  }
  EXPECT_EQ(at_corner, 2U);
}

TEST(PatchBorder, ALineOfSamplesIsAboutACellWide) {
  const Patch line = patch_inside(20, [](double, double y) { return y == 10.0; });
  const PatchBorder border(line);
  for (const glm::dvec3& p : curve_of(line)) {
    if (p.x < 2.0 || p.x > 17.0) continue;
    EXPECT_NEAR(std::abs(p.y - 10.0), 0.5, 0.15);
  }
  double area = 0.0;
  for (const CutCell& piece : pieces_of(line)) area += 0.5 * twice_area(border, piece.polygon);
  EXPECT_NEAR(area, 20.0, 4.0);
}

TEST(PatchBorder, ContinuesTheSlope) {
  PatchModel model = test::height_field(9, [](double x, double) { return 0.5 * x; });
  const Patch& patch = model.patches[0];
  const double step = patch.height_step / patch.spacing;
  const PatchBorder border(patch);
  const double at_edge = patch.at(8, 4) * step;
  for (const glm::dvec3& p : curve_of(patch)) {
    if (p.x <= 8.0 || p.y != 4.0) continue;
    EXPECT_NEAR(p.z - at_edge, 0.5 * (p.x - 8.0), 2.0 * step);
    // Half a cell along the slope.
    EXPECT_NEAR(p.x - 8.0, 0.5 / std::sqrt(1.25), 0.01);
  }
}

TEST(PatchBorder, EndsBeforeAJump) {
  const PatchModel model =
      test::height_field(10, [](double x, double) { return x > 0.0 ? 30.0 : 0.0; });
  const PatchBorder border(model.patches[0]);
  EXPECT_TRUE(border.beside_jump({4, 5}));
  EXPECT_TRUE(border.beside_jump({5, 9}));
  EXPECT_FALSE(border.beside_jump({2, 9}));
  for (const CutCell& piece : pieces_of(model.patches[0])) EXPECT_NE(piece.cell.x, 4);
}

TEST(PatchBorder, FallsThroughAHalfBetweenSamplesAndHoles) {
  const Patch patch =
      patch_inside(30, [](double x, double y) { return std::fmod(x * 7.0 + y * 13.0, 5.0) < 3.0; });
  const PatchBorder border(patch);
  for (std::int32_t j = -1; j <= 30; ++j) {
    for (std::int32_t i = -1; i <= 30; ++i) {
      if (border.is_sample({i, j})) {
        EXPECT_GT(border.mean_at({i, j}), 0.5F);
      } else {
        EXPECT_LT(border.mean_at({i, j}), 0.5F);
      }
    }
  }
}

}  // namespace
}  // namespace relief

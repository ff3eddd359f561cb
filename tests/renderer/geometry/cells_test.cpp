#include "renderer/geometry/cells/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "common/seams/cell_triangles.h"
#include "renderer/geometry/cells/patch_border.h"
#include "shaders/include/shared.h"
#include "tests/renderer/scenes.h"

namespace relief {
namespace {

using Node = std::pair<std::uint32_t, std::uint32_t>;

PatchCells cells_of(const Patch& patch) {
  return make_cells(patch, make_samples(patch));
}

/// A flat patch whose nodes are holes where `hole` says so; heights tell the node.
Patch patch_with_holes(std::uint32_t width, std::uint32_t height,
                       const std::function<bool(std::uint32_t, std::uint32_t)>& hole) {
  Patch patch;
  patch.width = width;
  patch.height = height;
  patch.height_step = 1e-9;
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i)
      patch.heights.push_back(hole(i, j) ? kHole : static_cast<std::int32_t>((i + 7 * j) % 65000));
  }
  return patch;
}

/// Random holes in tatters of all lengths, so that runs begin and end everywhere.
Patch tattered_patch(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(11);
  std::geometric_distribution<int> length(0.04);
  bool hole = false;
  int left = 0;
  return patch_with_holes(width, height, [&](std::uint32_t, std::uint32_t) {
    while (left == 0) {
      hole = !hole;
      left = hole ? length(random) / 8 : length(random);
    }
    --left;
    return hole;
  });
}

/// A height as fetch_height of heights.glsl reads it.
std::uint32_t fetch_height(const PatchCells& cells, std::uint32_t i, std::uint32_t j) {
  const CellRow& row = cells.rows[j];
  if (i < (row.span & 0xFFFFU) || i >= row.span >> 16U) return shared::kHoleTexel;
  return cells.heights[row.base + i];
}

TEST(Cells, HeightsAreFoundByTheirRows) {
  const Patch patch = tattered_patch(61, 40);
  const PatchCells cells = cells_of(patch);
  ASSERT_EQ(cells.rows.size(), 41U);
  for (std::uint32_t j = 0; j < 41; ++j) {
    for (std::uint32_t i = 0; i < 62; ++i) {  // one beyond the last, as shaders ask for
      const std::int32_t h = i < 61 && j < 40 ? patch.at(i, j) : kHole;
      EXPECT_EQ(fetch_height(cells, i, j), h == kHole ? shared::kHoleTexel : h) << i << " " << j;
    }
  }
}

TEST(Cells, EachCellWithFourSamplesIsInOneRun) {
  // Ten parts each way, of which the last are narrow.
  const Patch patch = tattered_patch(9 * shared::kPartCells + 20, 9 * shared::kPartCells + 3);
  std::set<Node> expected;
  for (std::uint32_t j = 0; j + 1 < patch.height; ++j) {
    for (std::uint32_t i = 0; i + 1 < patch.width; ++i) {
      if (patch.at(i, j) != kHole && patch.at(i + 1, j) != kHole && patch.at(i, j + 1) != kHole &&
          patch.at(i + 1, j + 1) != kHole)
        expected.emplace(i, j);
    }
  }
  std::set<Node> drawn;
  std::size_t count = 0;
  const PatchCells cells = cells_of(patch);
  EXPECT_EQ(cells.parts.size(), 100U);
  for (const CellPart& part : cells.parts) {
    for (const std::uint32_t run : part.runs) {
      const std::uint32_t i = part.corner.x + (run & shared::kNodeInPartMask);
      const std::uint32_t j =
          part.corner.y + ((run >> shared::kNodeInPartBits) & shared::kNodeInPartMask);
      const std::uint32_t length = (run >> (2 * shared::kNodeInPartBits)) & shared::kRunCellsMask;
      EXPECT_GE(length, 1U);
      EXPECT_LE(length, static_cast<std::uint32_t>(shared::kRunCells));
      for (std::uint32_t k = 0; k < length; ++k) drawn.emplace(i + k, j);
      count += length;
    }
  }
  EXPECT_GT(count, 10000U);
  EXPECT_EQ(count, drawn.size());
  EXPECT_EQ(drawn, expected);
}

/// The nodes that have a splat.
std::set<Node> rims_of(const PatchCells& cells) {
  std::set<Node> rims;
  for (const CellPart& part : cells.parts) {
    for (const RimRecord& rim : part.rims)
      rims.emplace(
          part.corner.x + (rim.node & shared::kNodeInPartMask),
          part.corner.y + ((rim.node >> shared::kNodeInPartBits) & shared::kNodeInPartMask));
  }
  return rims;
}

TEST(Cells, AreNotDrawnWhereThePatchJumpsToAnotherSheet) {
  // Two columns of two cells, of which the second rises by almost what splats lean, then by more.
  for (const double rise : {0.99 * shared::kSteepest, 1.01 * shared::kSteepest}) {
    const PatchModel model =
        test::height_field(3, [&](double x, double) { return x > 0.5 ? rise : 0.0; });
    std::uint32_t drawn = 0;
    for (const CellPart& part : cells_of(model.patches[0]).parts) {
      for (const std::uint32_t run : part.runs) {
        drawn += (run >> (2 * shared::kNodeInPartBits)) & shared::kRunCellsMask;
      }
    }
    EXPECT_EQ(drawn, rise < shared::kSteepest ? 4U : 2U);
  }
}

TEST(Cells, HolesCutTheCellsBesideThem) {
  const Patch patch = tattered_patch(9 * shared::kPartCells + 20, 9 * shared::kPartCells + 3);
  const PatchBorder border(patch);
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint32_t>> expected;
  const glm::i32vec2 end(patch.width, patch.height);
  for (glm::i32vec2 cell(-1); cell.y < end.y; ++cell.y) {
    for (cell.x = -1; cell.x < end.x; ++cell.x) {
      border.for_each_polygon(cell, [&](const BorderPolygon& polygon) {
        expected[{cell.x, cell.y}].push_back(polygon.slots);
      });
    }
  }
  ASSERT_GT(expected.size(), 1000U);
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::uint32_t>> drawn;
  for (const CellPart& part : cells_of(patch).parts) {
    EXPECT_TRUE(part.rims.empty()) << "the patch is flat: no creases";
    for (const BorderCell& packed : part.borders) {
      const glm::i32vec2 cell =
          glm::i32vec2(part.corner) - 1 +
          glm::i32vec2(packed.cell & shared::kNodeInPartMask,
                       (packed.cell >> shared::kNodeInPartBits) & shared::kNodeInPartMask);
      drawn[{cell.x, cell.y}].push_back((packed.cell >> shared::kBorderSlotsShift) & 0xFFU);
    }
  }
  EXPECT_EQ(drawn, expected);
}

TEST(Cells, SplatsKeepTheirSlopesAndDoNotReachTowardHoles) {
  const PatchModel roof =
      test::height_field(10, [](double x, double y) { return -0.9 * std::abs(x) - 0.1 * y; });
  const Patch& patch = roof.patches[0];
  const PatchSamples samples = make_samples(patch);
  const PatchCells cells = make_cells(patch, samples);
  ASSERT_EQ(cells.parts.size(), 1U);
  ASSERT_GE(cells.parts[0].rims.size(), 16U);
  for (const RimRecord& rim : cells.parts[0].rims) {
    const std::uint32_t i = rim.node & shared::kNodeInPartMask;
    const std::uint32_t j = (rim.node >> shared::kNodeInPartBits) & shared::kNodeInPartMask;
    const SampleRecord& record = samples.records[j * patch.width + i];
    EXPECT_EQ(rim.node >> 16U, record.shape >> 16U);
    const auto byte = [](std::uint32_t packed, int side) { return (packed >> (8 * side)) & 0xFFU; };
    EXPECT_GE(byte(rim.reach, 0), byte(record.reach, 0));
    EXPECT_GE(byte(rim.reach, 1), byte(record.reach, 1));
    EXPECT_EQ(byte(rim.reach, 2) == 0, j == 0);
    EXPECT_EQ(byte(rim.reach, 3) == 0, j == 9);
  }
}

TEST(Cells, ACreaseHasSplatsAndARoundingHasNone) {
  // A roof of 45 degrees between two columns of nodes: each side's planes go on by half a cell
  // above the cell that cuts the ridge off, 0.35 along their normals.
  const PatchModel roof = test::height_field(20, [](double x, double) { return -std::abs(x); });
  const std::set<Node> splats = rims_of(cells_of(roof.patches[0]));
  for (std::uint32_t j = 2; j < 18; ++j) {
    EXPECT_TRUE(splats.contains({9, j})) << j;
    EXPECT_TRUE(splats.contains({10, j})) << j;
    EXPECT_FALSE(splats.contains({5, j})) << j;
  }
  // A radius of 5 cells turns by 11 degrees a cell and is off the edges by 0.05.
  const PatchModel round =
      test::height_field(20, [](double x, double) { return std::sqrt(225.0 - x * x); });
  EXPECT_TRUE(rims_of(cells_of(round.patches[0])).empty());
}

TEST(Cells, OfALevelHaveSplatsOnlyBesideJumps) {
  // A step of 30 cells between columns 20 and 21: in level 1 between those of columns 20 and 22,
  // which are 11 and 12 there. What a hole touches reaches beyond the patch instead.
  const PatchModel step =
      test::height_field(41, [](double x, double) { return x < 0.5 ? 0.0 : 30.0; });
  const PatchLevel level = coarsen(step.patches[0], 1);
  std::set<Node> expected;
  for (std::uint32_t j = 1; j <= 21; ++j) expected.insert({{11, j}, {12, j}});
  EXPECT_EQ(rims_of(make_cells(level, make_samples(level.grid))), expected);
}

TEST(Cells, OfALevelAreEdgesWhereAHoleTouchesThem) {
  const Patch patch = tattered_patch(61, 40);
  const PatchLevel level = coarsen(patch, 1);
  const PatchCells cells = make_cells(level, make_samples(level.grid));
  const auto cells_in = [&cells](const auto member, int most) {
    std::set<Node> found;
    for (const CellPart& part : cells.parts) {
      for (const std::uint32_t run : part.*member) {
        const std::uint32_t i = part.corner.x + (run & shared::kNodeInPartMask);
        const std::uint32_t j =
            part.corner.y + ((run >> shared::kNodeInPartBits) & shared::kNodeInPartMask);
        const std::uint32_t count = (run >> (2 * shared::kNodeInPartBits)) & shared::kRunCellsMask;
        EXPECT_LE(count, static_cast<std::uint32_t>(most));
        for (std::uint32_t c = 0; c < count; ++c) EXPECT_TRUE(found.insert({i + c, j}).second);
      }
    }
    return found;
  };
  const std::set<Node> whole = cells_in(&CellPart::runs, shared::kRunCells);
  const std::set<Node> edges = cells_in(&CellPart::edge_runs, shared::kEdgeRunCells);
  EXPECT_GT(whole.size(), 20U);
  EXPECT_GT(edges.size(), 20U);
  for (const Node& node : whole)
    EXPECT_EQ(level.whole[node.second * level.grid.width + node.first], 1);
  for (const Node& node : edges)
    EXPECT_EQ(level.whole[node.second * level.grid.width + node.first], 0);
}

TEST(Cells, SpheresHoldTheirPart) {
  const PatchModel model = test::height_field(
      300, [](double x, double y) { return 20.0 * std::sin(0.05 * x + 0.03 * y); });
  const Patch& patch = model.patches[0];
  const PatchSamples samples = make_samples(patch);
  const PatchCells cells = make_cells(patch, samples);
  ASSERT_EQ(cells.parts.size(), 121U);
  for (const CellPart& part : cells.parts) {
    const auto expect_inside = [&](std::uint32_t i, std::uint32_t j) {
      const glm::dvec3 p(i, j, patch.at(i, j) * static_cast<double>(samples.height_step));
      EXPECT_LE(glm::distance(p, part.centre), part.radius + 1e-9) << i << " " << j;
    };
    for (const std::uint32_t run : part.runs) {
      const std::uint32_t i = part.corner.x + (run & shared::kNodeInPartMask);
      const std::uint32_t j =
          part.corner.y + ((run >> shared::kNodeInPartBits) & shared::kNodeInPartMask);
      const std::uint32_t length = (run >> (2 * shared::kNodeInPartBits)) & shared::kRunCellsMask;
      expect_inside(i, j + 1);
      expect_inside(i + length, j);
    }
    // No sphere is larger than that of a square part of slopes up to 1.17.
    EXPECT_LT(part.radius, 0.5 * std::hypot(1.0, 1.0, 1.17) * std::sqrt(2.0) * shared::kPartCells);
  }
}

TEST(Cells, TakeFourBytesASample) {
  // Issue 4's bound, for a patch about as large and as ragged as the Dragon's: a disc of 1,900
  // samples. Two bytes are the heights; an eighth of the samples are at the border, 8 bytes each.
  const double radius = std::sqrt(1900.0 / std::acos(-1.0));
  const Patch patch = patch_with_holes(51, 51, [radius](std::uint32_t i, std::uint32_t j) {
    return std::hypot(i - 25.0, j - 25.0) > radius;
  });
  const PatchCells cells = cells_of(patch);
  std::size_t bytes =
      sizeof(std::uint16_t) * cells.heights.size() + sizeof(CellRow) * cells.rows.size();
  for (const CellPart& part : cells.parts) {
    bytes += sizeof(std::uint32_t) * part.runs.size() + sizeof(RimRecord) * part.rims.size() +
             sizeof(BorderCell) * part.borders.size();
  }
  EXPECT_LE(static_cast<double>(bytes), 4.0 * static_cast<double>(count_samples(patch)));
}

TEST(Cells, PatchesTooSmallForAWholeCellHaveCutOnes) {
  for (const std::uint32_t width : {1U, 2U}) {
    const Patch patch =
        patch_with_holes(width, 1, [](std::uint32_t, std::uint32_t) { return false; });
    const PatchCells cells = cells_of(patch);
    ASSERT_EQ(cells.parts.size(), 1U);
    EXPECT_TRUE(cells.parts[0].runs.empty());
    EXPECT_TRUE(cells.parts[0].rims.empty());
    EXPECT_EQ(cells.parts[0].borders.size(), 2 * (width + 1));
  }
}

/// A corner of a triangle: a node of the patch.
glm::ivec2 node_of_strip(const CellPart& part, std::uint16_t packed) {
  return glm::ivec2(part.corner) +
         glm::ivec2(packed & shared::kStripColumnMask, packed >> shared::kStripRowShift);
}

TEST(Cells, OfAPatchThatMeetsOthersAreStripsOfItsWholeCells) {
  const Patch patch = tattered_patch(61, 40);
  const CellTriangles triangles = cell_triangles(patch);
  std::map<Node, int> drawn;  // triangles of a cell
  for (const CellPart& part : make_joined_cells(patch).parts) {
    EXPECT_TRUE(part.runs.empty());
    EXPECT_TRUE(part.edge_runs.empty());
    EXPECT_TRUE(part.rims.empty());
    for (std::size_t k = 0; k + 2 < part.strip.size(); ++k) {
      // OpenGL reverses every other triangle of a strip, so that all of them face alike.
      const glm::ivec2 a = node_of_strip(part, part.strip[k + k % 2]);
      const glm::ivec2 b = node_of_strip(part, part.strip[k + 1 - k % 2]);
      const glm::ivec2 c = node_of_strip(part, part.strip[k + 2]);
      const int twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      if (twice_area == 0) continue;
      EXPECT_EQ(twice_area, 1) << "counterclockwise from the normals' side";
      const glm::ivec2 cell = glm::min(a, glm::min(b, c));
      ++drawn[{cell.x, cell.y}];
    }
  }
  std::size_t whole = 0;
  for (std::uint32_t j = 0; j < triangles.rows; ++j) {
    for (std::uint32_t i = 0; i < triangles.columns; ++i) {
      if (triangles.at(i, j) != kWholeCell) continue;
      ++whole;
      EXPECT_EQ((drawn[{i, j}]), 2) << i << " " << j;
    }
  }
  EXPECT_GT(whole, 500U);
  EXPECT_EQ(drawn.size(), whole);
}

TEST(Cells, PatchOfHolesHasNone) {
  const Patch patch = patch_with_holes(30, 30, [](std::uint32_t, std::uint32_t) { return true; });
  const PatchCells cells = cells_of(patch);
  EXPECT_TRUE(cells.parts.empty());
  EXPECT_TRUE(cells.heights.empty());
}

}  // namespace
}  // namespace relief

#include "loader/stream/chunks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace relief {
namespace {

/// A patch of `side` nodes a side, 1 apart, over z = 0 from (x, y).
PatchSummary flat_patch(double x, double y, std::uint32_t side) {
  PatchSummary patch;
  patch.origin = {x, y, 0.0};
  patch.width = patch.height = side;
  patch.samples = side * side;
  return patch;
}

/// 32 by 32 patches of 100 x 100 nodes, column by column.
std::vector<PatchSummary> square_of_patches() {
  std::vector<PatchSummary> patches;
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 32; ++j) patches.push_back(flat_patch(100.0 * i, 100.0 * j, 100));
  }
  return patches;
}

TEST(Chunks, HaveEachPatchOnceAndNoMoreNodesThanTheyMay) {
  const std::vector<PatchSummary> patches = square_of_patches();
  const TileIndex index = index_tile(patches, false);
  std::vector<int> times(patches.size(), 0);
  for (const ChunkInfo& chunk : index.chunks) {
    EXPECT_LE(chunk.nodes, kChunkNodes);
    EXPECT_EQ(chunk.nodes, 10'000 * chunk.patches.size());
    EXPECT_EQ(chunk.samples, chunk.nodes);
    for (const std::uint32_t p : chunk.patches) {
      ++times[p];
      EXPECT_GE(patches[p].origin.x, chunk.box.min.x - 1e-9);
      EXPECT_LE(patches[p].origin.x + 99.0, chunk.box.max.x + 1e-9);
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), 1024);
  EXPECT_LE(index.chunks.size(), 1024U / 13U + 1U) << "all but the last are full";
}

TEST(Chunks, AreOfNeighbours) {
  const TileIndex index = index_tile(square_of_patches(), false);
  double area = 0.0;
  for (const ChunkInfo& chunk : index.chunks) {
    const glm::dvec3 size = chunk.box.max - chunk.box.min;
    area += size.x * size.y;
  }
  // The square has 3200 x 3200; columns of 13 patches that wrap would have boxes of 32 rows.
  EXPECT_LT(area, 3.0 * 3200.0 * 3200.0);
}

TEST(Chunks, KeepPatchesThatMeetTogether) {
  const TileIndex index = index_tile(square_of_patches(), true);
  ASSERT_EQ(index.chunks.size(), 1U);
  EXPECT_TRUE(index.chunks.front().is_joined);
  EXPECT_TRUE(
      std::is_sorted(index.chunks.front().patches.begin(), index.chunks.front().patches.end()));
}

TEST(Chunks, LeaveOutPatchesWithoutSamplesAndGiveLargeOnesAChunkOfTheirOwn) {
  std::vector<PatchSummary> patches{flat_patch(0.0, 0.0, 10), flat_patch(10.0, 0.0, 1000),
                                    flat_patch(20.0, 0.0, 10)};
  patches[0].samples = 0;
  const TileIndex index = index_tile(patches, false);
  ASSERT_EQ(index.chunks.size(), 2U);
  EXPECT_EQ(index.chunks[0].patches.size() + index.chunks[1].patches.size(), 2U);
  EXPECT_TRUE(index_tile({}, false).chunks.empty());
}

}  // namespace
}  // namespace relief

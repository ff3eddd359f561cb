#include "loader/stream/chunk_cost.h"

#include <gtest/gtest.h>

namespace relief {
namespace {

StoreNeeds needs_of_cells() {
  StoreNeeds needs;
  needs.cells = needs.normals = needs.colours = needs.masks = true;
  return needs;
}

const ChunkCost kFine = usual_cost_a_node({2.0, 1, 2}, needs_of_cells());
const ChunkCost kCoarse = usual_cost_a_node({2.0, 1, 1}, needs_of_cells());

TEST(ChunkCost, ABudgetIsDividedWhole) {
  const ChunkCost room = divide_budget(1'000'000, kFine, kCoarse, 1e9);
  EXPECT_NEAR(room.all(), 1e6, 1.0);
  EXPECT_EQ(room.maps.heights, 0.0) << "nobody needs them";
}

/// Whether a view fits that needs a share of the budget, and of whose nodes a share is the finest.
bool fits(double share, double finest) {
  ChunkCost a_node = finest * kFine;
  a_node += (1.0 - finest) * kCoarse;
  const ChunkCost view = share * 1e6 / a_node.all() * a_node;
  return view.fits(divide_budget(1'000'000, kFine, kCoarse, 1e9));
}

TEST(ChunkCost, HalfOfABudgetIsUsedByWhateverIsInView) {
  EXPECT_TRUE(fits(0.5, 0.0));
  EXPECT_TRUE(fits(0.5, 1.0));
  // Of views of a whole scan 0.03 to 0.7 of the nodes are the finest.
  EXPECT_TRUE(fits(0.7, 0.03));
  EXPECT_TRUE(fits(0.9, 0.3));
  EXPECT_TRUE(fits(0.7, 0.7));
}

TEST(ChunkCost, ASmallFileGetsNoMoreThanItNeeds) {
  const double nodes = 1000.0;
  const ChunkCost room = divide_budget(1'000'000'000, kFine, kCoarse, nodes);
  EXPECT_TRUE((nodes * kFine).fits(room));
  EXPECT_FALSE((2.0 * nodes * kFine).fits(room));
}

}  // namespace
}  // namespace relief

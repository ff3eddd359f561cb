// Long lists of draws are drawn in slices.
#include "renderer/engines/onepass/cell_draws.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "renderer/view/draw_list.h"

namespace relief::onepass {
namespace {

TEST(SlicesOfDraws, HaveEachCommandOnceAndAreNoLargerThanTheyMust) {
  std::vector<ArraysCommand> commands;
  for (GLuint count = 1; count <= 100; ++count) commands.push_back({count, count % 3 + 1, 0, 0});
  GLsizei next = 0;
  const std::vector<Commands::Slice> slices = slices_of(commands, 500);
  for (const Commands::Slice& slice : slices) {
    EXPECT_EQ(slice.first, next);
    std::uint64_t triangles = 0;
    for (GLsizei c = slice.first; c < slice.first + slice.count; ++c) {
      EXPECT_LT(triangles, 500U) << "the slice could have ended before command " << c;
      triangles += std::uint64_t{commands[c].count} * commands[c].instances;
    }
    EXPECT_EQ(slice.triangles, triangles);
    next += slice.count;
  }
  EXPECT_EQ(next, 100);
  EXPECT_GT(slices.size(), 10U);
}

TEST(SlicesOfDraws, AreOneWithoutABound) {
  const std::vector<ElementsCommand> commands(5, {1000000, 4, 0, 0, 0});
  EXPECT_EQ(slices_of(commands, std::numeric_limits<std::uint64_t>::max()).size(), 1U);
  EXPECT_TRUE(slices_of(std::vector<ElementsCommand>(), 1).empty());
}

}  // namespace
}  // namespace relief::onepass

#include "loader/stream/chunk_cache.h"

#include <gtest/gtest.h>

#include "renderer/store/pool/patch_chunk.h"

namespace relief {
namespace {

std::shared_ptr<const PatchChunk> a_chunk() {
  return std::make_shared<const PatchChunk>();
}

TEST(ChunkCaches, DropWhatWasAskedForLeastRecently) {
  ChunkCache cache(100);
  for (std::uint32_t c = 0; c < 4; ++c) cache.put({1, c}, a_chunk(), 25);
  EXPECT_EQ(cache.bytes(), 100U);
  EXPECT_NE(cache.get({1, 0}), nullptr);
  cache.put({1, 4}, a_chunk(), 50);
  EXPECT_EQ(cache.get({1, 1}), nullptr);
  EXPECT_EQ(cache.get({1, 2}), nullptr);
  EXPECT_NE(cache.get({1, 3}), nullptr);
  EXPECT_NE(cache.get({1, 0}), nullptr) << "it was asked for";
  EXPECT_EQ(cache.bytes(), 100U);
}

TEST(ChunkCaches, NeverExceedTheirBudget) {
  ChunkCache cache(100);
  cache.put({0, 0}, a_chunk(), 60);
  cache.put({0, 1}, a_chunk(), 101);
  EXPECT_EQ(cache.get({0, 1}), nullptr) << "larger than the budget";
  EXPECT_NE(cache.get({0, 0}), nullptr) << "nothing had to go for it";
  cache.put({0, 2}, a_chunk(), 60);
  EXPECT_LE(cache.bytes(), 100U);
  EXPECT_EQ(cache.size(), 1U);
}

TEST(ChunkCaches, ReplaceAnOlderChunk) {
  ChunkCache cache(100);
  cache.put({0, 0}, a_chunk(), 60);
  const auto newer = a_chunk();
  cache.put({0, 0}, newer, 30);
  EXPECT_EQ(cache.bytes(), 30U);
  EXPECT_EQ(cache.get({0, 0}), newer);
  cache.clear();
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(cache.get({0, 0}), nullptr);
}

}  // namespace
}  // namespace relief

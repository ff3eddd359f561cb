#include "renderer/store/pool/spans.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace relief {
namespace {

TEST(SpansOfPlaces, AreTakenFromTheFirstGapThatTheyFit) {
  Spans spans(10);
  EXPECT_EQ(spans.take(4), 0U);
  EXPECT_EQ(spans.take(4), 4U);
  EXPECT_FALSE(spans.has(7, 1));
  EXPECT_TRUE(spans.has(8, 2));
  EXPECT_FALSE(spans.has(8, 3));
  EXPECT_FALSE(spans.take(3));
  spans.give(0, 4);
  EXPECT_EQ(spans.take(2), 0U);
  EXPECT_EQ(spans.take(3), std::nullopt) << "gaps of two and of two";
  spans.give(4, 4);
  EXPECT_EQ(spans.take(8), 2U) << "gaps that touch are one";
  EXPECT_EQ(spans.taken(), 10U);
}

TEST(SpansOfPlaces, GrowAtTheEnd) {
  Spans spans;
  EXPECT_EQ(spans.take(0), 0U);
  EXPECT_FALSE(spans.take(1));
  spans.grow(3);
  EXPECT_EQ(spans.take(2), 0U);
  spans.grow(5);
  EXPECT_EQ(spans.take(3), 2U) << "what was left and what was added";
}

TEST(SpansOfPlaces, NeverOverlapHoweverTheyComeAndGo) {
  std::mt19937 random(7);
  Spans spans(200);
  std::vector<bool> is_taken(200, false);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> kept;
  for (int step = 0; step < 5000; ++step) {
    if (random() % 2 == 0 || kept.empty()) {
      const std::uint32_t count = 1 + random() % 20;
      const std::uint32_t at = random() % 200;
      std::optional<std::uint32_t> first;
      if (random() % 2 == 0) {
        first = spans.take(count);
      } else if (spans.has(at, count)) {
        first = at;
        spans.take(at, count);
      }
      if (!first) continue;
      for (std::uint32_t k = *first; k < *first + count; ++k) {
        ASSERT_FALSE(is_taken.at(k));
        is_taken[k] = true;
      }
      kept.emplace_back(*first, count);
    } else {
      const std::size_t which = random() % kept.size();
      const auto [first, count] = kept[which];
      for (std::uint32_t k = first; k < first + count; ++k) is_taken[k] = false;
      spans.give(first, count);
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(which));
    }
  }
  for (const auto& [first, count] : kept) spans.give(first, count);
  EXPECT_EQ(spans.taken(), 0U);
  EXPECT_EQ(spans.take(200), 0U);
}

}  // namespace
}  // namespace relief

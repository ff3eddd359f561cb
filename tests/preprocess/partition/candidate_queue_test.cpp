#include "preprocess/partition/candidate_queue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace relief {
namespace {

constexpr auto kAllPairs = [](const Candidate& /*candidate*/) { return true; };

/// Takes all that are current, in the queue's order.
template <class IsCurrent>
std::vector<Candidate> take_all(CandidateQueue& queue, const IsCurrent& is_current) {
  std::vector<Candidate> taken;
  while (const Candidate* best = queue.best(is_current)) {
    taken.push_back(*best);
    queue.pop();
  }
  return taken;
}

void expect_in_order(const std::vector<Candidate>& taken) {
  for (std::size_t k = 1; k < taken.size(); ++k)
    ASSERT_FALSE(taken[k - 1].is_worse_than(taken[k])) << "at " << k;
}

TEST(CandidateQueue, GivesTheBestFirst) {
  // Beyond the least and the most that have buckets of their own, many alike.
  std::mt19937 random(1);
  std::uniform_int_distribution<int> exponent(-20, 8);
  CandidateQueue queue;
  for (std::uint32_t k = 0; k < 5000; ++k)
    queue.push({std::ldexp(1.0, exponent(random)), k % 70, k % 110, 0, 0});
  queue.push({0.0, 1, 2, 0, 0});
  const std::vector<Candidate> taken = take_all(queue, kAllPairs);
  EXPECT_EQ(taken.size(), 5001U);
  expect_in_order(taken);
}

TEST(CandidateQueue, GivesWhatIsPushedLateInItsTurn) {
  CandidateQueue queue;
  for (std::uint32_t k = 1; k <= 100; ++k) queue.push({0.01 * k, k, 0, 0, 0});
  for (int k = 0; k < 50; ++k) {
    ASSERT_NE(queue.best(kAllPairs), nullptr);
    queue.pop();
  }
  queue.push({0.005, 200, 0, 0, 0});  // better than all that are left
  queue.push({0.755, 201, 0, 0, 0});
  const std::vector<Candidate> taken = take_all(queue, kAllPairs);
  ASSERT_EQ(taken.size(), 52U);
  EXPECT_EQ(taken.front().a, 200U);
  expect_in_order(taken);
}

TEST(CandidateQueue, LeavesOutWhatIsVoid) {
  CandidateQueue queue;
  for (std::uint32_t k = 0; k < 100; ++k) queue.push({1.0 + 0.1 * k, k, 0, k % 2, 0});
  const auto taken = take_all(queue, [](const Candidate& c) { return c.version_a == 1; });
  EXPECT_EQ(taken.size(), 50U);
  EXPECT_EQ(queue.best(kAllPairs), nullptr);
}

TEST(CandidateQueue, GivesWhatHasNoCostLast) {
  CandidateQueue queue;
  queue.push({std::numeric_limits<double>::quiet_NaN(), 1, 0, 0, 0});
  queue.push({2.0, 2, 0, 0, 0});
  const std::vector<Candidate> taken = take_all(queue, kAllPairs);
  ASSERT_EQ(taken.size(), 2U);
  EXPECT_EQ(taken.front().a, 2U);
}

}  // namespace
}  // namespace relief

#include "common/legend/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace relief {
namespace {

std::vector<std::string> texts(double low, double high, int most) {
  std::vector<std::string> all;
  for (const Tick& tick : find_ticks(low, high, most)) all.push_back(tick.text);
  return all;
}

using Texts = std::vector<std::string>;

TEST(Ticks, AreRoundNumbers) {
  EXPECT_EQ(texts(175, 2062, 6), (Texts{"500", "1000", "1500", "2000"}));
  EXPECT_EQ(texts(0, 1, 6), (Texts{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(texts(-18, -1, 5), (Texts{"-15", "-10", "-5"}));
  EXPECT_EQ(texts(-0.1, 0.1, 3), (Texts{"-0.1", "0.0", "0.1"}));
  EXPECT_EQ(texts(0.0008, 0.0188, 6), (Texts{"0.005", "0.010", "0.015"}));
}

TEST(Ticks, HaveTheDigitsThatTellThemApart) {
  // Northings of UTM, and GPS times, over a narrow range.
  EXPECT_EQ(texts(4918340.4, 4918341.6, 4), (Texts{"4918340.5", "4918341.0", "4918341.5"}));
  EXPECT_EQ(texts(3e8 + 0.125, 3e8 + 0.2, 4),
            (Texts{"300000000.14", "300000000.16", "300000000.18", "300000000.20"}));
  EXPECT_EQ(texts(2.5e-9, 8.4e-9, 5), (Texts{"4e-09", "6e-09", "8e-09"}));
  EXPECT_EQ(texts(1.0e15, 1.3e15, 4), (Texts{"1.0e+15", "1.1e+15", "1.2e+15", "1.3e+15"}));
}

TEST(Ticks, OfOneValueAreOne) {
  EXPECT_EQ(texts(7326, 7326, 6), (Texts{"7326"}));
  EXPECT_EQ(texts(1e16, 1e16 + 2, 6).size(), 1U);  // nothing lies between
}

TEST(Ticks, LieWithinTheRangeAndDiffer) {
  for (int k = 0; k < 400; ++k) {
    const double low = std::pow(10.0, k % 19 - 9) * (k % 7 - 3);
    const double high = low + std::pow(10.0, k % 13 - 8) * (1 + k % 9);
    const int most = 2 + k % 9;
    const std::vector<Tick> ticks = find_ticks(low, high, most);
    EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
    std::set<std::string> different;
    for (const Tick& tick : ticks) {
      EXPECT_GE(tick.value, low);
      EXPECT_LE(tick.value, high);
      different.insert(tick.text);
    }
    EXPECT_EQ(different.size(), ticks.size()) << low << " to " << high;
    EXPECT_GE(ticks.size(), 1U) << low << " to " << high << ", " << most;
  }
}

}  // namespace
}  // namespace relief

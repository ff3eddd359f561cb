#include "viewer/choices/text_of.h"

#include <gtest/gtest.h>

#include <limits>

namespace relief {
namespace {

TEST(TextOf, CountsHaveGapsBetweenThousands) {
  EXPECT_EQ(count_text(0), "0");
  EXPECT_EQ(count_text(9999), "9999");
  EXPECT_EQ(count_text(10000), "10 000");
  EXPECT_EQ(count_text(1234567), "1 234 567");
}

TEST(TextOf, SizesHaveTheUnitThatSuitsThem) {
  EXPECT_EQ(size_text(999), "999 bytes");
  EXPECT_EQ(size_text(1000), "1.0 kB");
  EXPECT_EQ(size_text(9949), "9.9 kB");
  EXPECT_EQ(size_text(9950), "10 kB");
  EXPECT_EQ(size_text(999'499), "999 kB");
  EXPECT_EQ(size_text(999'500), "1.0 MB");
  EXPECT_EQ(size_text(60'000'000'000), "60 GB");
}

TEST(TextOf, PositionsHaveAsManyDecimalsAsTheBoxNeeds) {
  EXPECT_EQ(position_text({-0.0947, 0.0527, 0.0}, {0.205, 0.145, 0.09}), "-0.0947, 0.0527, 0.0000");
  // UTM coordinates of a box of 300 m: to a decimetre.
  EXPECT_EQ(position_text({515000.26, 4918000.04, 2300.0}, {300.0, 300.0, 50.0}),
            "515000.3, 4918000.0, 2300.0");
  EXPECT_EQ(position_text({1.0, 2.0, 3.0}, {20000.0, 1.0, 1.0}), "1, 2, 3");
}

TEST(TextOf, PositionsInBoxesThatAreNoneDoNoHarm) {
  EXPECT_EQ(position_text({1.0, 2.0, 3.0}, glm::dvec3(0.0)), "1.000, 2.000, 3.000");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(position_text({1.0, 2.0, infinite}, glm::dvec3(infinite)), "1.000, 2.000, inf");
  EXPECT_EQ(extent_text({0.20512, 0.145, 91.25}), "0.2051 \xC3\x97 0.145 \xC3\x97 91.25");
}

}  // namespace
}  // namespace relief

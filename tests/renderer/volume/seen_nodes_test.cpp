#include "renderer/volume/seen_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/bounds.h"

namespace relief {
namespace {

/// 20 x 18 x 16 nodes with spacing 2; a block of `value` from node (5, 6, 7) to (9, 11, 8), else 0.
ScalarVolume block(float value) {
  ScalarVolume volume{{20, 18, 16}, RegularGrid{glm::dvec3(0.0), 2.0 * glm::dmat3(1.0)}, {}};
  for (std::uint32_t k = 0; k < 16; ++k) {
    for (std::uint32_t j = 0; j < 18; ++j) {
      for (std::uint32_t i = 0; i < 20; ++i) {
        const bool is_in = i >= 5 && i <= 9 && j >= 6 && j <= 11 && k >= 7 && k <= 8;
        volume.values.push_back(is_in ? value : 0.0F);
      }
    }
  }
  return volume;
}

TransferFunction opaque_from(double value) {
  TransferFunction function;
  function.colours = {{0.0, glm::vec3(1.0F)}};
  function.opacities = {{value, 0.0}, {value + 1.0, 0.5}};
  return function;
}

Bounds bounds_seen(const ScalarVolume& volume, std::vector<TransferFunction> functions,
                   std::vector<double> isos) {
  return bounds_of(seen_nodes(volume, functions, isos));
}

TEST(SeenNodes, AreThoseThatAFunctionShows) {
  const Bounds seen = bounds_seen(block(10.0F), {opaque_from(3.0)}, {});
  EXPECT_EQ(seen.min, glm::dvec3(10.0, 12.0, 14.0));
  EXPECT_EQ(seen.max, glm::dvec3(18.0, 22.0, 16.0));
  EXPECT_TRUE(seen_nodes(block(10.0F), std::vector{opaque_from(10.0)}, {}).empty())
      << "the first stop is transparent";
}

TEST(SeenNodes, AreThoseOfAllFunctions) {
  TransferFunction all = opaque_from(3.0);
  all.opacities = {{0.0, 0.1}};
  const Bounds seen = bounds_seen(block(10.0F), {opaque_from(3.0), all}, {});
  EXPECT_EQ(seen.min, glm::dvec3(0.0));
  EXPECT_EQ(seen.max, glm::dvec3(38.0, 34.0, 30.0));
}

TEST(SeenNodes, HaveASurfaceBesideThem) {
  const Bounds seen = bounds_seen(block(10.0F), {}, {4.0});
  EXPECT_EQ(seen.min, glm::dvec3(8.0, 12.0, 14.0)) << "the node before the surface, too";
  EXPECT_EQ(seen.max, glm::dvec3(20.0, 22.0, 16.0));
  EXPECT_TRUE(seen_nodes(block(10.0F), {}, std::vector{11.0}).empty());
}

TEST(SeenNodes, AreNoneWithoutValues) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  const ScalarVolume volume = block(nothing);
  EXPECT_TRUE(seen_nodes(volume, std::vector{opaque_from(3.0)}, std::vector{4.0}).empty());
}

TEST(SeenNodes, OfScatteredPointsAreNotKnown) {
  ScalarVolume volume{{2, 1, 1}, ScatteredPoints{}, {5.0F, 5.0F}};
  EXPECT_TRUE(seen_nodes(volume, std::vector{opaque_from(3.0)}, {}).empty());
}

}  // namespace
}  // namespace relief

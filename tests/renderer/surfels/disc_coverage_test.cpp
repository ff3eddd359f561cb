// The measure of gaps and overlap that the sizes of surfels are judged by.
#include "tests/renderer/surfels/disc_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/surfels/surfels.h"
#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief {
namespace {

/// Discs on a square lattice of spacing 0.1 over the plane, as wide as that.
struct Lattice {
  std::vector<glm::dvec3> centres;
  std::vector<glm::vec3> normals;
  std::vector<double> diameters;

  Lattice() {
    for (int k = 0; k < 23 * 23; ++k) {
      centres.emplace_back(0.1 * (k % 23 - 11), 0.1 * (k / 23 - 11), 0.0);
      normals.emplace_back(0.0F, 0.0F, 1.0F);
      diameters.push_back(0.1);
    }
  }
};

TEST(DiscCoverage, MeasuresALattice) {
  const Lattice lattice;
  const test::DiscCoverage coverage(test::surface_truth(test::Shape::Plane, 200000),
                                    lattice.centres, lattice.normals, lattice.diameters);
  // A disc's area over its square's. The samples tell areas to about 1 / sqrt(200000) = 0.2 %, and
  // bins of scale are 0.5 % wide.
  EXPECT_NEAR(coverage.uncovered(1.0), 1.0 - std::numbers::pi / 4.0, 0.002);
  EXPECT_NEAR(coverage.overlap(1.0), std::numbers::pi / 4.0, 0.01);
  EXPECT_NEAR(coverage.overlap(2.0), std::numbers::pi, 0.04);
  // The middle of a square is half its diagonal away; of 450 samples a square some are as near to
  // it as 0.1 % of the spacing... 3 % at worst.
  EXPECT_NEAR(coverage.closing(0.0), std::sqrt(2.0), 0.02);
  EXPECT_EQ(coverage.uncovered(coverage.closing(0.0)), 0.0);
  EXPECT_LE(coverage.uncovered(coverage.closing(0.01)), 0.01);
}

TEST(DiscCoverage, TakesNoDiscOfAnotherSheet) {
  Lattice lattice;
  for (glm::dvec3& centre : lattice.centres) centre.z = -0.5;
  const auto truth = test::surface_truth(test::Shape::Plane, 1000);
  EXPECT_EQ(
      test::DiscCoverage(truth, lattice.centres, lattice.normals, lattice.diameters).uncovered(4.0),
      1.0)
      << "half a unit below";
  for (std::size_t k = 0; k < lattice.centres.size(); ++k) {
    lattice.centres[k].z = 0.0;
    lattice.normals[k] = -lattice.normals[k];
  }
  EXPECT_EQ(
      test::DiscCoverage(truth, lattice.centres, lattice.normals, lattice.diameters).uncovered(4.0),
      1.0)
      << "they face away";
}

}  // namespace
}  // namespace relief

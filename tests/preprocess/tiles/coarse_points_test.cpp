#include "preprocess/tiles/coarse_points.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/image/srgb.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

/// A patch without holes or noise, on a slope.
Patch slope(std::uint32_t width, std::uint32_t height, std::uint32_t colours) {
  test::PatchShape shape;
  shape.width = width;
  shape.height = height;
  shape.noise = 0.0;
  shape.round = false;
  shape.colours = colours;
  Patch patch = test::bumpy_patch(shape);
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i)
      patch.heights[std::size_t{j} * width + i] = static_cast<std::int32_t>(100 + 20 * i + 8 * j);
  }
  const glm::vec3 normal = glm::normalize(glm::vec3(-1.0F, -0.4F, 1.0F));
  patch.normals.texels.assign(patch.normals.texels.size(), snorm16_from_unit(normal));
  return patch;
}

/// In nodes and height steps.
glm::dvec3 in_grid(const Patch& patch, glm::dvec3 position) {
  return glm::transpose(patch.axes) * (position - patch.origin) /
         glm::dvec3(patch.spacing, patch.spacing, patch.height_step);
}

TEST(CoarsePoints, AreMeansOfTwoByTwoNodes) {
  const Patch patch = slope(5, 4, 0);
  const Points points = coarse_points(patch);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_TRUE(points.colours.empty());
  const glm::dvec3 expected[] = {{0.5, 0.5, 114.0}, {2.5, 0.5, 154.0}, {4.0, 0.5, 184.0},
                                 {0.5, 2.5, 130.0}, {2.5, 2.5, 170.0}, {4.0, 2.5, 200.0}};
  const glm::vec3 normal = glm::mat3(patch.axes) * glm::normalize(glm::vec3(-1.0F, -0.4F, 1.0F));
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Coordinates are about five million, of which doubles know 1e-9.
    EXPECT_LT(glm::distance(in_grid(patch, points.positions[i]), expected[i]), 1e-6) << i;
    // Steps of 16-bit octahedral normals.
    EXPECT_LT(glm::distance(points.normals[i], normal), 1e-4F) << i;
  }
}

TEST(CoarsePoints, HolesCountForNothing) {
  Patch patch = slope(4, 2, 0);
  patch.heights[1] = patch.heights[4] = patch.heights[5] = kHole;  // all but node 0 of the first
  for (const std::size_t node : {2, 3, 6, 7}) patch.heights[node] = kHole;
  const Points points = coarse_points(patch);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_LT(glm::distance(in_grid(patch, points.positions[0]), {0.0, 0.0, 100.0}), 1e-6);
}

TEST(CoarsePoints, ColoursAreMeansOfLight) {
  Patch patch = slope(2, 2, 2);
  // Texels of a chessboard: as bright from afar as half of its light, not as sRGB 127.
  for (std::uint32_t b = 0; b < 3; ++b) {
    for (std::uint32_t a = 0; a < 3; ++a)
      patch.colours.texels[3 * b + a] = glm::u8vec3((a + b) % 2 == 0 ? 255 : 0);
  }
  const Points points = coarse_points(patch);
  ASSERT_EQ(points.colours.size(), 1U);
  // Each node has four texels about it, two of them white.
  EXPECT_EQ(points.colours[0], glm::u8vec3(srgb8_from_linear(0.5F)));
}

TEST(CoarsePoints, NumbersAreMeansAndLabelsTheMostFrequent) {
  Patch patch = slope(4, 2, 0);
  const ScalarInfo number{"height_index", false, -10.0, 0.5, {}};
  const ScalarInfo label{"class", true, 1.0, 1.0, {}};
  const auto map = [](std::vector<std::uint16_t> codes) {
    return AttributeMap<std::uint16_t>{4, 2, 1, std::move(codes)};
  };
  patch.scalars = {map({10, 20, 7, kNoScalar, 30, 40, kNoScalar, kNoScalar}),
                   map({5, 2, 6, 3, 5, 8, kNoScalar, 3})};
  const Points points = coarse_points(patch, std::array{number, label});
  ASSERT_EQ(points.scalars.size(), 2U);
  EXPECT_EQ(points.scalars[0].values, (std::vector<double>{2.5, -6.5}));
  EXPECT_TRUE(points.scalars[1].is_label);
  EXPECT_EQ(points.scalars[1].values, (std::vector<double>{6.0, 4.0}));
  patch.scalars[0] = map(std::vector<std::uint16_t>(8, kNoScalar));
  EXPECT_TRUE(std::isnan(coarse_points(patch, std::array{number, label}).scalars[0].values[0]));
}

}  // namespace
}  // namespace relief

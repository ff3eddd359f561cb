// Scalars of points become maps of patches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "preprocess/convert.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

/// A plane of points about a unit apart with a number that grows with x, and a label of its halves.
Points plane_with_scalars(int side) {
  std::mt19937 random(3);
  const auto next = [&random] { return static_cast<double>(random()) * 0x1p-32 - 0.5; };
  Points points;
  PointScalar ramp{"ramp", false, {}};
  PointScalar half{"half_label", true, {}};
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const glm::dvec3 p(i + 0.5 * next(), j + 0.5 * next(), 0.0);
      points.positions.push_back(p);
      ramp.values.push_back(1000.0 + 0.25 * p.x);
      half.values.push_back(p.y < 0.5 * side ? 3 : 17);
    }
  }
  points.scalars = {ramp, half};
  return points;
}

PatchModel convert_all(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  auto result = convert(points, options, progress);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(result->model);
}

/// Calls `visit(position, value)` for each sample; `value` is NaN where there is none.
template <class Visit>
void for_each_value(const PatchModel& model, std::size_t scalar, const Visit& visit) {
  for (const Patch& patch : model.patches) {
    const AttributeMap<std::uint16_t>& map = patch.scalars[scalar];
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const std::uint16_t code =
            map.texels[std::size_t{j} * map.scale * map.width + i * map.scale];
        visit(position_of(patch, i, j),
              code == kNoScalar ? std::nan("") : model.scalars[scalar].value_of(code));
      }
    }
  }
}

TEST(ScalarMaps, FollowTheNumbersOfThePoints) {
  const PatchModel model = convert_all(plane_with_scalars(40));
  ASSERT_EQ(model.scalars.size(), 2U);
  EXPECT_EQ(model.scalars[0].name, "ramp");
  double sum = 0.0;
  std::size_t count = 0;
  for_each_value(model, 0, [&](glm::dvec3 position, double value) {
    const double within = std::clamp(position.x, 0.0, 39.0);
    sum += (value - 1000.0 - 0.25 * within) * (value - 1000.0 - 0.25 * within);
    ++count;
  });
  // Kriging between points a unit apart leaves a tenth of a unit, and a quarter of that in values;
  // the nearest point would leave 0.25 * 0.4.
  EXPECT_LT(std::sqrt(sum / static_cast<double>(count)), 0.05);
}

TEST(ScalarMaps, OfLabelsHoldNoOthers) {
  const PatchModel model = convert_all(plane_with_scalars(40));
  EXPECT_TRUE(model.scalars[1].is_label);
  std::size_t wrong = 0;
  for (const Patch& patch : model.patches) {
    for (const std::uint16_t code : patch.scalars[1].texels) {
      if (code == kNoScalar) continue;
      const double label = model.scalars[1].value_of(code);
      EXPECT_TRUE(label == 3 || label == 17) << label;
    }
  }
  for_each_value(model, 1, [&](glm::dvec3 position, double label) {
    const bool near_border = std::abs(position.y - 20.0) < 1.0;
    if (!near_border && label != (position.y < 20.0 ? 3 : 17)) ++wrong;
  });
  EXPECT_EQ(wrong, 0U);
}

TEST(ScalarMaps, HaveNoValueWhereThePointsHaveNone) {
  Points points = plane_with_scalars(40);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points.positions[k].x < 10.0) points.scalars[0].values[k] = std::nan("");
  }
  const PatchModel model = convert_all(points);
  for_each_value(model, 0, [](glm::dvec3 position, double value) {
    if (std::abs(position.x - 10.0) < 1.5) return;
    EXPECT_EQ(std::isnan(value), position.x < 10.0) << position.x;
  });
  // The numbers beside them are not drawn toward anything.
  EXPECT_GT(model.scalars[0].offset, 1002.0);
}

TEST(ScalarMaps, OfPointsWithoutAnyValueAreLeftOut) {
  Points points = plane_with_scalars(12);
  points.scalars[0].values.assign(points.size(), std::nan(""));
  const PatchModel model = convert_all(points);
  ASSERT_EQ(model.scalars.size(), 1U);
  EXPECT_EQ(model.scalars[0].name, "half_label");
  EXPECT_EQ(model.patches.front().scalars.size(), 1U);
}

TEST(ScalarMaps, DependOnNeitherThreadsNorColours) {
  Points points = plane_with_scalars(30);
  ConvertOptions options;
  options.threads = 1;
  const PatchModel one = convert_all(points, options);
  options.threads = 3;
  points.colours.assign(points.size(), glm::u8vec3(9));
  const PatchModel three = convert_all(points, options);
  ASSERT_EQ(one.patches.size(), three.patches.size());
  for (std::size_t p = 0; p < one.patches.size(); ++p) {
    EXPECT_EQ(one.patches[p].heights, three.patches[p].heights);
    for (std::size_t s = 0; s < 2; ++s)
      EXPECT_EQ(one.patches[p].scalars[s].texels, three.patches[p].scalars[s].texels);
  }
}

TEST(ScalarMaps, OfAMeshReachIntoItsTriangles) {
  // Squares of 1 unit, and one of 8: points in it get mixed numbers and the labels of their nearest
  // corner.
  Points mesh;
  mesh.positions = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (std::uint32_t j = 0; j < 8; ++j) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
        mesh.positions.push_back(corner + glm::dvec3(20 + i, j, 0));
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  PointScalar x{"x_value", false, {}};
  PointScalar label{"label", true, {}};
  for (const glm::dvec3& p : mesh.positions) {
    x.values.push_back(p.x);
    label.values.push_back(p.x < 4.0 ? 1 : 2);
  }
  mesh.scalars = {x, label};
  ConvertOptions options;
  options.spacing = 0.5;
  const PatchModel model = convert_all(mesh, options);
  for_each_value(model, 0, [](glm::dvec3 position, double value) {
    EXPECT_NEAR(value, std::clamp(position.x, 0.0, 28.0), 0.5) << position.x;
  });
  for_each_value(model, 1, [](glm::dvec3 position, double value) {
    // A triangle's corners have equal weights at its centroid, 4/3 from the middle; added points
    // are about a unit apart.
    if (std::abs(position.x - 4.0) < 4.0 / 3.0 + 1.0) return;
    EXPECT_EQ(value, position.x < 4.0 ? 1.0 : 2.0) << position.x;
  });
}

TEST(Distances, AreThoseToTheNearestPoint) {
  ConvertOptions options;
  options.distances = true;
  const Points points = test::sample_torus({}, 0.05);
  const PatchModel model = convert_all(points, options);
  ASSERT_EQ(model.scalars.size(), 1U);
  EXPECT_EQ(model.scalars[0].name, "distance");
  std::size_t samples = 0;
  for_each_value(model, 0, [&](glm::dvec3 position, double value) {
    if (++samples % 50 != 0) return;
    double nearest = 1e300;
    for (const glm::dvec3& p : points.positions)
      nearest = std::min(nearest, glm::distance(p, position));
    EXPECT_NEAR(value, nearest, model.scalars[0].step);
  });
  EXPECT_GT(samples, 1000U);
}

TEST(Distances, AreNotMeasuredUnlessAskedFor) {
  EXPECT_TRUE(convert_all(test::sample_torus({}, 0.05)).scalars.empty());
}

}  // namespace
}  // namespace relief

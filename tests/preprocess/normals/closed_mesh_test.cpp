// What is known to be closed: a mistake here leaves parts of a model out of its images.
#include "preprocess/normals/closed_mesh.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

#include "preprocess/convert.h"
#include "preprocess/readers/read_points.h"

namespace relief {
namespace {

/// A box from `low` to `high`, its triangles counter-clockwise seen from outside.
Points box(glm::dvec3 low = glm::dvec3(0.0), glm::dvec3 high = glm::dvec3(1.0)) {
  Points mesh;
  for (std::uint32_t k = 0; k < 8; ++k) {
    mesh.positions.emplace_back((k & 1U) != 0 ? high.x : low.x, (k & 2U) != 0 ? high.y : low.y,
                                (k & 4U) != 0 ? high.z : low.z);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

Points turned_inside_out(Points mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

Points both(Points a, const Points& b) {
  const auto before = static_cast<std::uint32_t>(a.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + before, t[1] + before, t[2] + before});
  return a;
}

bool is_closed(const Points& mesh) {
  return is_closed_mesh(mesh, mesh.size(), MeshEdges(mesh));
}

bool is_borderless(const Points& mesh) {
  return is_borderless_mesh(mesh, mesh.size(), MeshEdges(mesh));
}

TEST(ClosedMesh, IsABodyWhereverItStands) {
  EXPECT_TRUE(is_closed(box()));
  EXPECT_TRUE(is_closed(box({5e6, -3e6, 1e6}, {5e6 + 1.0, -3e6 + 0.5, 1e6 + 2.0})));
  EXPECT_TRUE(is_closed(both(box(), box(glm::dvec3(2.0), glm::dvec3(3.0)))));
}

TEST(ClosedMesh, IsNotWithATriangleMissingTwiceOrFlipped) {
  for (std::size_t t = 0; t < box().triangles.size(); ++t) {
    Points missing = box();
    missing.triangles.erase(missing.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    EXPECT_FALSE(is_closed(missing)) << t;
    Points flipped = box();
    std::swap(flipped.triangles[t][1], flipped.triangles[t][2]);
    EXPECT_FALSE(is_closed(flipped)) << t;
    Points twice = box();
    twice.triangles.push_back(twice.triangles[t]);
    EXPECT_FALSE(is_closed(twice)) << t;
  }
}

TEST(ClosedMesh, IsNotInsideOutInAnyPiece) {
  const Points small = box(glm::dvec3(2.0), glm::dvec3(2.5));
  EXPECT_FALSE(is_closed(turned_inside_out(box())));
  EXPECT_FALSE(is_closed(both(box(), turned_inside_out(small))));
  EXPECT_FALSE(is_closed(both(turned_inside_out(small), box())));
}

TEST(ClosedMesh, IsNotIfPointsOrNormalsSayOtherwise) {
  EXPECT_FALSE(is_closed(Points{}));
  Points scan = box();
  scan.triangles.clear();
  EXPECT_FALSE(is_closed(scan));
  Points lone = box();
  lone.positions.emplace_back(9.0, 9.0, 9.0);
  EXPECT_FALSE(is_closed(lone));
  Points outward = box();
  Points inward = box();
  for (const glm::dvec3 p : box().positions) {
    outward.normals.emplace_back(p - 0.5);
    inward.normals.emplace_back(0.5 - p);
  }
  EXPECT_TRUE(is_closed(outward));
  EXPECT_FALSE(is_closed(inward));
}

TEST(ClosedMesh, NeedNotBeOneToHaveNoBorder) {
  EXPECT_TRUE(is_borderless(box()));
  // Two boxes that have an edge in common, which has four triangles.
  const Points touching = clean_points(both(box(), box(glm::dvec3(1, 1, 0), {2, 2, 1}))).points;
  EXPECT_FALSE(is_closed(touching));
  EXPECT_TRUE(is_borderless(touching));
  Points open = touching;
  open.triangles.pop_back();
  EXPECT_FALSE(is_borderless(open));
  EXPECT_FALSE(is_borderless(Points{}));
}

TEST(ClosedMesh, HasNoBorderWithAFewLonePoints) {
  Points mesh;
  for (int k = 0; k < 20; ++k) mesh = both(mesh, box(glm::dvec3(2.0 * k), glm::dvec3(2.0 * k + 1)));
  mesh.positions.emplace_back(-9.0, -9.0, -9.0);
  EXPECT_FALSE(is_closed(mesh));
  EXPECT_TRUE(is_borderless(mesh));  // one point of 161
  mesh.positions.emplace_back(-8.0, -9.0, -9.0);
  EXPECT_FALSE(is_borderless(mesh));
}

/// Faces that have points of their own, as STL has them, are one body once these are merged.
TEST(ClosedMesh, IsNotedByAConversion) {
  Points soup;
  const std::uint32_t side = 8;  // a conversion needs points
  const Points coarse = box();
  for (const Triangle& t : coarse.triangles) {
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
      const double u = static_cast<double>(i) / side;
      const double v = static_cast<double>(j) / side;
      return coarse.positions[t[0]] + u * (coarse.positions[t[1]] - coarse.positions[t[0]]) +
             v * (coarse.positions[t[2]] - coarse.positions[t[0]]);
    };
    const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
      const auto first = static_cast<std::uint32_t>(soup.size());
      soup.positions.insert(soup.positions.end(), {a, b, c});
      soup.triangles.push_back({first, first + 1, first + 2});
    };
    for (std::uint32_t j = 0; j < side; ++j) {
      for (std::uint32_t i = 0; i + j < side; ++i) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < side) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  EXPECT_FALSE(is_closed(soup));
  Progress progress;
  Points merged = clean_points(soup).points;
  const auto closed = convert(merged, {}, progress);
  ASSERT_TRUE(closed) << closed.error().message;
  EXPECT_TRUE(closed->model.is_closed);
  EXPECT_TRUE(closed->model.joined.front().is_closed);
  Points twice = merged;  // touches itself: not known to be a body, but it has no border
  twice.triangles.push_back(twice.triangles.front());
  const auto borderless = convert(twice, {}, progress);
  ASSERT_TRUE(borderless) << borderless.error().message;
  EXPECT_FALSE(borderless->model.is_closed);
  EXPECT_TRUE(borderless->model.joined.front().is_closed);
  merged.triangles.pop_back();
  const auto open = convert(merged, {}, progress);
  ASSERT_TRUE(open) << open.error().message;
  EXPECT_FALSE(open->model.is_closed);
  EXPECT_FALSE(open->model.joined.front().is_closed);
}

}  // namespace
}  // namespace relief

// Coarse meshes of models seen from afar: what they are made of, and when they are drawn.
#include "renderer/geometry/proxy/proxy_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "common/seams/make_seams.h"
#include "renderer/geometry/proxy/proxy.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

constexpr Sphere kUnitSphere{{0.0, 0.0, 0.0}, 1.0};

PatchModel fine_sphere(bool coloured = false) {
  return test::sphere_model({.spacing = 0.01, .patches_per_side = 2, .coloured = coloured});
}

TEST(FarSpacings, BeginAtTwoPixelsOrAtTwiceTheModels) {
  // 2 of kProxyDiameter pixels, which are the diameter.
  const std::vector<double> fine = proxy_spacings(kUnitSphere, 1e-6);
  ASSERT_FALSE(fine.empty());
  EXPECT_DOUBLE_EQ(fine.front(), 2.0 * 2.0 / kProxyDiameter);
  for (std::size_t k = 1; k < fine.size(); ++k)
    EXPECT_NEAR(fine[k] / fine[k - 1], std::sqrt(2.0), 1e-12);
  // Three cubes along the diameter are the coarsest.
  EXPECT_LT(3.0 * fine.back(), 2.0);
  EXPECT_GE(3.0 * std::sqrt(2.0) * fine.back(), 2.0);

  for (const double s : proxy_spacings(kUnitSphere, 0.1)) EXPECT_GE(s, 0.2);
  EXPECT_FALSE(proxy_spacings(kUnitSphere, 0.1).empty());
  EXPECT_TRUE(proxy_spacings(kUnitSphere, 0.5).empty());
  EXPECT_TRUE(proxy_spacings({{0.0, 0.0, 0.0}, 0.0}, 0.0).empty());
}

std::vector<ProxyLevel> levels_of(const PatchModel& model, std::vector<double> spacings) {
  return make_proxy_levels(model.patches, {},
                           {sphere_about(model.patches), kProxyPixels, std::move(spacings)});
}

/// A view that looks along -z; a pixel is 0.001 at depth 1.
View plain_view() {
  View view;
  view.width = view.height = 1000;
  view.slope_x = view.slope_y = 0.5;
  view.proxy_diameter = kProxyDiameter;
  return view;
}

Proxy model_at(double depth, double spacing, double pixels = kProxyPixels) {
  return {{{0.0, 0.0, -depth}, 1.0}, pixels, {spacing}};
}

TEST(IsProxy, BelowTheDiameterAndOnlyWhereItIsFineEnough) {
  View view = plain_view();
  // Its nearest point is at 2000 / kProxyDiameter where it is just that wide.
  const double limit = 2000.0 / kProxyDiameter + 1.0;
  EXPECT_TRUE(is_proxy(view, model_at(1.001 * limit, 1e-3)));
  EXPECT_FALSE(is_proxy(view, model_at(0.999 * limit, 1e-3)));
  const double half = 4000.0 / kProxyDiameter + 1.0;
  EXPECT_TRUE(is_proxy(view, model_at(1.001 * half, 1e-3, kProxyPixelsOfMaps)));
  EXPECT_FALSE(is_proxy(view, model_at(0.999 * half, 1e-3, kProxyPixelsOfMaps)));
  // At four pixels, there 0.001 times 100.
  EXPECT_TRUE(is_proxy(view, model_at(101.0, 0.399)));
  EXPECT_FALSE(is_proxy(view, model_at(101.0, 0.401)));
  EXPECT_FALSE(is_proxy(view, model_at(-100.0, 1e-3)));
  EXPECT_FALSE(is_proxy(view, {{{0.0, 0.0, -101.0}, 1.0}, kProxyPixels, {}}));
  Proxy wider = model_at(0.999 * limit, 1e-3);
  wider.diameter = kProxyDiameterJoined;
  EXPECT_TRUE(is_proxy(view, wider));
  view.proxy_diameter = 0.0;
  EXPECT_FALSE(is_proxy(view, model_at(101.0, 1e-3)));
}

TEST(IsProxy, SamplesOfAPixelChangeNothing) {
  const View view = plain_view();
  const View finer = view_of_part(view, {0, 0, 1000, 1000, 4});
  for (const double depth : {5.0, 15.0, 17.0, 50.0, 1000.0}) {
    for (const double spacing : {0.001, 0.1, 1.0}) {
      const Proxy model = model_at(depth, spacing);
      EXPECT_EQ(is_proxy(view, model), is_proxy(finer, model)) << depth;
    }
  }
}

TEST(ProxyLevels, AreAsCoarseAsPixelsAllow) {
  Proxy model = model_at(101.0, 0.0);
  model.spacings = {0.05, 0.1, 0.199, 0.201, 0.4};  // a pixel is 0.1
  EXPECT_EQ(choose_proxy_level(plain_view(), model), 2U);
  model.pixels = 1.0;
  EXPECT_EQ(choose_proxy_level(plain_view(), model), 1U);
  model.spacings = {0.3, 0.4};
  EXPECT_EQ(choose_proxy_level(plain_view(), model), 0U);
}

TEST(ProxyMesh, LiesOnTheSurfaceAndCoversItOnce) {
  const PatchModel model = fine_sphere();
  const std::vector<double> spacings = proxy_spacings(kUnitSphere, 0.01);
  const std::vector<ProxyLevel> levels = levels_of(model, spacings);
  ASSERT_EQ(levels.size(), spacings.size());
  for (const ProxyLevel& level : levels) {
    const double h = level.spacing;
    for (const ProxyVertex& vertex : level.vertices) {
      // A tangent plane at most half a cube's diagonal away is 3/8 h^2 off the unit sphere; heights
      // are rounded to a thousandth of 0.01.
      EXPECT_NEAR(glm::length(vertex.position), 1.0, 0.5 * h * h + 1e-4) << h;
      const double length = glm::length(vertex.normal);
      EXPECT_LE(length, 1.0 + 1e-6);
      // Normals in a cube are at most its diagonal apart.
      EXPECT_GE(glm::dot(glm::dvec3(vertex.normal), glm::normalize(vertex.position)),
                1.0 - 1.5 * h * h - 1e-4)
          << h;
      EXPECT_LT(vertex.patch, model.patches.size());
    }
    std::set<Triangle> seen;
    double outward = 0.0;
    double inward = 0.0;
    for (const Triangle& t : level.triangles) {
      EXPECT_TRUE(t[0] < t[1] && t[0] < t[2] && t[1] != t[2]);
      EXPECT_TRUE(seen.insert(t).second);
      const auto p = [&](std::size_t k) { return level.vertices[t[k]].position; };
      const glm::dvec3 across = glm::cross(p(1) - p(0), p(2) - p(0));
      (glm::dot(across, p(0) + p(1) + p(2)) > 0.0 ? outward : inward) += glm::length(across);
    }
    // The sphere's area, twice. Planes meet outside it, neighbouring patches overlap, and where
    // cubes cut small corners off the surface a triangle may fold over.
    const double twice = 8.0 * std::acos(-1.0);
    EXPECT_GT(outward - inward, (1.0 - 0.5 * h * h) * twice) << h;
    EXPECT_LT(outward - inward, (1.04 + h * h) * twice) << h;
    EXPECT_LT(inward, 0.04 * outward) << h;
    // A vertex has about six triangles, each shared by three.
    EXPECT_LT(level.triangles.size(), 3 * level.vertices.size());
  }
  EXPECT_GT(levels.front().vertices.size(), 10 * levels.back().vertices.size());
}

/// Edges of triangles that no triangle has the other way around.
std::size_t border_edges(const std::vector<Triangle>& triangles) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(t[k], t[(k + 1) % 3]);
  }
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
    return !edges.contains({edge.second, edge.first});
  }));
}

TEST(ProxyMesh, OfPatchesThatMeetIsClosed) {
  // Patches that do not overlap: without their seams nothing joins them.
  const PatchModel model =
      test::sphere_model({.spacing = 0.03, .patches_per_side = 2, .overlap_cells = -0.3});
  const Seams seams = make_seams(model.patches, true);
  const Proxy proxy{sphere_about(model.patches), kProxyPixels, proxy_spacings(kUnitSphere, 0.03)};
  ASSERT_GE(proxy.spacings.size(), 3U);
  const std::vector<JoinedPatches> joined{{0, &seams}};
  for (const ProxyLevel& level : make_proxy_levels(model.patches, joined, proxy))
    EXPECT_EQ(border_edges(level.triangles), 0U) << level.spacing;
  const std::vector<ProxyLevel> open = make_proxy_levels(model.patches, {}, proxy);
  EXPECT_GT(border_edges(open.front().triangles), 0U);
}

TEST(ProxyMesh, AThinSheetKeepsBothSides) {
  PatchModel front = test::height_field(40, [](double, double) { return 0.0; });
  Patch back = front.patches[0];
  back.origin.z -= 0.1;
  back.axes = glm::dmat3({0, 1, 0}, {1, 0, 0}, {0, 0, -1});
  front.patches.push_back(back);
  const ProxyLevel level = levels_of(front, {4.0}).front();
  std::size_t up = 0;
  for (const ProxyVertex& vertex : level.vertices) {
    const bool faces_up = vertex.normal.z > 0.0F;
    up += faces_up ? 1 : 0;
    EXPECT_NEAR(std::abs(vertex.normal.z), 1.0, 1e-6);
    EXPECT_NEAR(vertex.position.z, faces_up ? 0.0 : -0.1, 1e-9);
    EXPECT_EQ(vertex.patch, faces_up ? 0U : 1U);
  }
  EXPECT_EQ(2 * up, level.vertices.size());
}

TEST(ProxyMesh, ColoursAreMeansOfLight) {
  // Columns of black and white in turns: any cube of whole columns has as many of both.
  PatchModel model = test::height_field(33, [](double, double) { return 0.0; });
  Patch& patch = model.patches[0];
  patch.colours = {patch.width, patch.height, 1, {}};
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i)
      patch.colours.texels.emplace_back(i % 2 == 0 ? 0 : 255);
  }
  std::size_t whole = 0;
  const std::vector<ProxyLevel> levels = levels_of(model, {8.0});
  for (const ProxyVertex& vertex : levels.front().vertices) {
    if (std::abs(vertex.position.x) > 12.0) continue;  // a cube that the border cuts
    ++whole;
    EXPECT_NEAR(vertex.colour.r, 0.5, 1e-6);
  }
  EXPECT_GT(whole, 0U);
}

TEST(ProxyMesh, NormalsThatCancelMakeNoNaN) {
  PatchModel model = test::height_field(9, [](double, double) { return 0.0; });
  Patch& patch = model.patches[0];
  // Two texels a cell: around each node as many lean to one side as to the other.
  patch.normals = {2 * (patch.width - 1) + 1, 2 * (patch.height - 1) + 1, 2, {}};
  for (std::uint32_t k = 0; k < patch.normals.width * patch.normals.height; ++k)
    patch.normals.texels.emplace_back(k % 2 == 0 ? 32767 : -32767, 0);
  const std::vector<ProxyLevel> levels = levels_of(model, {3.0});
  for (const ProxyVertex& vertex : levels.front().vertices) {
    EXPECT_TRUE(std::isfinite(vertex.position.x) && std::isfinite(vertex.position.z));
    EXPECT_TRUE(std::isfinite(vertex.normal.x) && std::isfinite(vertex.normal.z));
  }
}

TEST(ProxyMesh, IsTheSameFarFromTheOrigin) {
  PatchModel model = fine_sphere();
  const std::vector<double> spacings{0.1};
  const ProxyLevel here = levels_of(model, spacings).front();
  const glm::dvec3 there(500000.0, 4e6, -3e9);
  for (Patch& patch : model.patches) patch.origin += there;
  const ProxyLevel moved = levels_of(model, spacings).front();
  // Doubles at 3e9 are 5e-7 apart: samples between two cubes may fall into the other.
  EXPECT_NEAR(static_cast<double>(moved.vertices.size()), static_cast<double>(here.vertices.size()),
              5.0);
  for (const ProxyVertex& vertex : moved.vertices)
    EXPECT_NEAR(glm::length(vertex.position - there), 1.0, 0.5 * 0.1 * 0.1 + 1e-4);
}

}  // namespace
}  // namespace relief

// Normal maps of patches that were made of meshes with normal maps.
#include "preprocess/texture/maps/normal_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>

#include "common/image/srgb.h"
#include "common/mesh/normal_texture.h"
#include "common/octahedral.h"
#include "preprocess/convert.h"
#include "preprocess/texture/maps/texture_maps.h"

namespace relief {
namespace {

/// A texture of `side` texels that has the unit vector `normal(u, v)` at its texels' middles.
using Relief = std::function<glm::dvec3(double, double)>;
MeshMaterial with_normals(std::uint32_t side, const Relief& normal) {
  std::vector<glm::i16vec3> texels;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i)
      texels.push_back(NormalTexture::texel_of(
          glm::vec3(glm::normalize(normal((i + 0.5) / side, 1.0 - (j + 0.5) / side)))));
  }
  MeshMaterial material;
  material.normals.texture =
      std::make_shared<const NormalTexture>(side, side, std::move(texels), TextureWrap::Clamp);
  return material;
}

/// The square [-1, 1]^2 at z = 0, facing up, which shows [0, 1]^2 of its texture.
Points square(const MeshMaterial& material, glm::dvec3 offset = glm::dvec3(0.0)) {
  Points mesh;
  for (const glm::dvec2 p : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.positions.push_back(offset + glm::dvec3(p, 0.0));
    mesh.texcoords.emplace_back(0.5 * p + 0.5);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_materials = {0, 0};
  mesh.materials = {material};
  return mesh;
}

/// A patch of 9 x 9 nodes over it, turned by `degrees` about its normal.
Patch square_patch(double degrees = 0.0, glm::dvec3 offset = glm::dvec3(0.0)) {
  Patch patch;
  patch.spacing = 0.25;
  patch.height_step = 0.01;
  patch.width = patch.height = 9;
  patch.heights.assign(81, 0);
  const double a = degrees * std::acos(-1.0) / 180.0;
  patch.axes[0] = {std::cos(a), std::sin(a), 0.0};
  patch.axes[1] = {-std::sin(a), std::cos(a), 0.0};
  patch.origin = offset - patch.axes[0] - patch.axes[1];
  patch.normals = {9, 9, 1, {}};
  patch.normals.texels.assign(81, snorm16_from_unit({0.0F, 0.0F, 1.0F}));
  return patch;
}

Status map(const Points& mesh, std::uint32_t texels, std::vector<Patch>& patches) {
  Progress progress;
  return map_textures(mesh, texels, patches, progress);
}

glm::dvec3 world_normal(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  const auto& map = patch.normals;
  return patch.axes * glm::dvec3(unit_from_snorm16(map.texels[std::size_t{j} * map.width + i]));
}

double degrees_between(glm::dvec3 a, glm::dvec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::acos(-1.0);
}

/// Two roundings to 16 bits, of the texture and of the map: 0.0025 degrees each at most.
constexpr double kRounding = 0.006;

TEST(NormalMaps, ATiltComesOutAsItIsWhereverThePatchStands) {
  const glm::dvec3 tilt = glm::normalize(glm::dvec3(0.3, -0.2, 0.8));
  const MeshMaterial tilted = with_normals(64, [&](double, double) { return tilt; });
  for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(5.0e5, 4.2e6, 300.0)}) {
    for (const double degrees : {0.0, 90.0, 217.0}) {
      const Points mesh = square(tilted, offset);
      std::vector<Patch> patches{square_patch(degrees, offset)};
      patches[0].heights[40] = kHole;
      ASSERT_TRUE(map(mesh, 0, patches));
      // 64 texels over 8 cells.
      ASSERT_EQ(patches[0].normals.scale, 8U);
      ASSERT_EQ(patches[0].normals.texels.size(), 65U * 65U);
      for (std::uint32_t j = 0; j < 65; ++j) {
        for (std::uint32_t i = 0; i < 65; ++i)
          ASSERT_LT(degrees_between(world_normal(patches[0], i, j), tilt), kRounding);
      }
    }
  }
}

TEST(NormalMaps, MirroredAndTurnedTextureCoordinatesTurnTheTiltWithThem) {
  const glm::dvec3 tilt = glm::normalize(glm::dvec3(0.3, -0.2, 0.8));
  const MeshMaterial tilted = with_normals(16, [&](double, double) { return tilt; });
  const auto tilt_with = [&](const std::function<glm::vec2(glm::vec2)>& change) {
    Points mesh = square(tilted);
    for (glm::vec2& texcoord : mesh.texcoords) texcoord = change(texcoord);
    std::vector<Patch> patches{square_patch()};
    EXPECT_TRUE(map(mesh, 0, patches));
    return world_normal(patches[0], 9, 5);
  };
  EXPECT_LT(degrees_between(tilt_with([](glm::vec2 t) { return glm::vec2(1.0F - t.x, t.y); }),
                            {-tilt.x, tilt.y, tilt.z}),
            kRounding);
  EXPECT_LT(degrees_between(tilt_with([](glm::vec2 t) { return glm::vec2(t.x, 1.0F - t.y); }),
                            {tilt.x, -tilt.y, tilt.z}),
            kRounding);
  // u grows along +y and v along -x.
  EXPECT_LT(degrees_between(tilt_with([](glm::vec2 t) { return glm::vec2(t.y, 1.0F - t.x); }),
                            {-tilt.y, tilt.x, tilt.z}),
            kRounding);
}

TEST(NormalMaps, TheScaleOfAMapIsAFactorOnItsSlope) {
  MeshMaterial tilted = with_normals(16, [](double, double) { return glm::dvec3(0.3, 0.2, 0.8); });
  tilted.normals.scale = 0.5F;
  std::vector<Patch> patches{square_patch()};
  ASSERT_TRUE(map(square(tilted), 0, patches));
  EXPECT_LT(degrees_between(world_normal(patches[0], 3, 3), {0.15, 0.1, 0.8}), kRounding);
}

/// Waves whose slope along x is at most 0.6.
glm::dvec3 waves(double u, double v) {
  const double pi = std::acos(-1.0);
  return {-0.6 * std::cos(6.0 * pi * u), -0.4 * std::sin(4.0 * pi * v), 1.0};
}

TEST(NormalMaps, TexelsHaveTheNormalsOfTheirPositions) {
  std::vector<Patch> patches{square_patch()};
  ASSERT_TRUE(map(square(with_normals(256, waves)), 0, patches));
  const AttributeMap<glm::i16vec2>& normals = patches[0].normals;
  ASSERT_EQ(normals.scale, 32U);
  for (std::uint32_t j = 1; j + 1 < normals.height; ++j) {
    for (std::uint32_t i = 1; i + 1 < normals.width; ++i) {
      // A texel is the mean of four of the texture around it: half their distance squared times
      // the wave's second derivative, 0.6 (6 pi)^2 / 8 / 256^2 = 0.0004, which is 0.024 degrees.
      ASSERT_LT(degrees_between(world_normal(patches[0], i, j), waves(i / 256.0, j / 256.0)), 0.035)
          << i << ' ' << j;
    }
  }
}

TEST(NormalMaps, CoarserMapsAverageInsteadOfPickingTexels) {
  // Ridges of one texel: their mean points straight up, each of them 37 degrees away.
  const MeshMaterial ridges = with_normals(128, [](double u, double) {
    return glm::dvec3(static_cast<int>(u * 128.0) % 2 == 0 ? 0.6 : -0.6, 0.0, 0.8);
  });
  Points mesh = square(ridges);
  // A map's texels then lie on a ridge's middle each, not between two of them.
  for (glm::vec2& texcoord : mesh.texcoords) texcoord.x += 0.5F / 128.0F;
  std::vector<Patch> patches{square_patch()};
  ASSERT_TRUE(map(mesh, 2, patches));
  EXPECT_EQ(patches[0].normals.scale, 2U);
  for (std::uint32_t j = 1; j < 16; ++j) {
    for (std::uint32_t i = 1; i < 16; ++i)
      EXPECT_LT(degrees_between(world_normal(patches[0], i, j), {0.0, 0.0, 1.0}), kRounding);
  }
}

TEST(NormalMaps, PatchesOfWhatHasNoNormalMapStayAsTheyAre) {
  MeshMaterial plain;
  std::vector<Patch> patches{square_patch()};
  const std::vector<glm::i16vec2> before = patches[0].normals.texels;
  ASSERT_TRUE(map(square(plain), 8, patches));
  EXPECT_EQ(patches[0].colours.scale, 8U);
  EXPECT_EQ(patches[0].normals.scale, 1U);
  EXPECT_EQ(patches[0].normals.texels, before);
}

TEST(NormalMaps, ConversionsHaveThemAndDoNotDependOnThreads) {
  const Points mesh = square(with_normals(256, waves));
  ConvertOptions options;
  options.spacing = 0.02;
  Progress progress;
  options.threads = 1;
  const auto one = convert(mesh, options, progress);
  ASSERT_TRUE(one) << one.error().message;
  // 256 texels over 100 cells.
  EXPECT_EQ(one->report.normal_texels_per_cell, 4U);
  options.threads = 3;
  const auto three = convert(mesh, options, progress);
  ASSERT_TRUE(three);
  ASSERT_EQ(one->model.patches.size(), three->model.patches.size());
  for (std::size_t p = 0; p < one->model.patches.size(); ++p)
    EXPECT_EQ(one->model.patches[p].normals.texels, three->model.patches[p].normals.texels);
}

}  // namespace
}  // namespace relief

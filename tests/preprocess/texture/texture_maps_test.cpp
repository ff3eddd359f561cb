// Colour maps of patches that were made of textured meshes.
#include "preprocess/texture/maps/texture_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "common/image/srgb.h"
#include "common/mesh/mesh_texture.h"
#include "preprocess/convert.h"

namespace relief {
namespace {

/// A square [-1, 1]^2 at height z that shows [0, 1]^2 of its texture; upward or downward.
void add_square(Points& mesh, double z, bool upward, std::uint32_t material, glm::dvec3 offset) {
  const auto first = static_cast<std::uint32_t>(mesh.size());
  for (const glm::dvec2 p : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.positions.push_back(offset + glm::dvec3(p, z));
    mesh.texcoords.emplace_back(0.5 * p + 0.5);
  }
  for (Triangle t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
    if (!upward) std::swap(t[1], t[2]);
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.triangle_materials.push_back(material);
  }
}

MeshMaterial textured(std::uint32_t side, std::vector<glm::u8vec3> texels) {
  MeshMaterial material;
  material.texture =
      std::make_shared<const MeshTexture>(side, side, std::move(texels), TextureWrap::Clamp);
  return material;
}

/// Red grows with u and green with v, linear in light.
MeshMaterial ramp(std::uint32_t side) {
  std::vector<glm::u8vec3> texels;
  for (std::uint32_t j = 0; j < side; ++j) {
    for (std::uint32_t i = 0; i < side; ++i)
      texels.emplace_back(srgb8_from_linear((i + 0.5F) / side),
                          srgb8_from_linear(1.0F - (j + 0.5F) / side), 128);
  }
  return textured(side, std::move(texels));
}

/// A patch of 9 x 9 nodes over the square [-1, 1]^2, turned upward or downward.
Patch square_patch(double z, bool upward, glm::dvec3 offset) {
  Patch patch;
  patch.spacing = 0.25;
  patch.height_step = 0.01;
  patch.width = patch.height = 9;
  patch.heights.assign(81, 0);
  patch.normals = {9, 9, 1, std::vector<glm::i16vec2>(81)};
  if (!upward) {
    patch.axes[0] = {-1.0, 0.0, 0.0};
    patch.axes[2] = {0.0, 0.0, -1.0};
  }
  patch.origin = offset + glm::dvec3(upward ? -1.0 : 1.0, -1.0, z);
  return patch;
}

Status map_textures(const Points& mesh, std::uint32_t texels, std::vector<Patch>& patches) {
  Progress progress;
  return map_textures(mesh, texels, patches, progress);
}

TEST(TextureMaps, TexelsShowTheTextureAtTheirPosition) {
  for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(5.0e5, 4.2e6, 300.0)}) {
    Points mesh;
    mesh.materials = {ramp(128)};
    add_square(mesh, 0.0, true, 0, offset);
    std::vector<Patch> patches{square_patch(0.0, true, offset)};
    patches[0].heights[40] = kHole;
    ASSERT_TRUE(map_textures(mesh, 0, patches));
    const AttributeMap<glm::u8vec3>& colours = patches[0].colours;
    // 128 texels over 8 cells.
    EXPECT_EQ(colours.scale, 16U);
    ASSERT_EQ(colours.width, 129U);
    for (std::uint32_t j = 1; j + 1 < colours.height; ++j) {
      for (std::uint32_t i = 1; i + 1 < colours.width; ++i) {
        const glm::vec3 light = linear_from_srgb8(colours.texels[j * colours.width + i]);
        // Two roundings to 8 bits of at most half a step, which is 0.0045 at the light end.
        EXPECT_NEAR(light.r, static_cast<float>(i) / 128.0F, 0.0092F);
        EXPECT_NEAR(light.g, static_cast<float>(j) / 128.0F, 0.0092F);
      }
    }
  }
}

TEST(TextureMaps, CoarserMapsAverageInsteadOfPickingTexels) {
  std::vector<glm::u8vec3> checker;
  for (int k = 0; k < 128 * 128; ++k) checker.emplace_back((k + k / 128) % 2 == 0 ? 0 : 255);
  Points mesh;
  mesh.materials = {textured(128, std::move(checker))};
  add_square(mesh, 0.0, true, 0, glm::dvec3(0.0));
  std::vector<Patch> patches{square_patch(0.0, true, glm::dvec3(0.0))};
  ASSERT_TRUE(map_textures(mesh, 2, patches));
  EXPECT_EQ(patches[0].colours.width, 17U);
  // Half the light is 188, and every level rounds to 8 bits.
  for (const glm::u8vec3 texel : patches[0].colours.texels) EXPECT_NEAR(texel.g, 188, 1);
}

TEST(TextureMaps, ThinSheetsHaveTwoSides) {
  Points mesh;
  MeshMaterial red;
  red.colour = {1.0F, 0.0F, 0.0F};
  MeshMaterial blue;
  blue.colour = {0.0F, 0.0F, 1.0F};
  mesh.materials = {red, blue};
  add_square(mesh, 0.02, true, 0, glm::dvec3(0.0));
  add_square(mesh, 0.0, false, 1, glm::dvec3(0.0));
  // Patches exactly between the sides: only their orientation decides.
  std::vector<Patch> patches{square_patch(0.01, true, glm::dvec3(0.0)),
                             square_patch(0.01, false, glm::dvec3(0.0))};
  ASSERT_TRUE(map_textures(mesh, 4, patches));
  for (const glm::u8vec3 texel : patches[0].colours.texels)
    EXPECT_EQ(texel, glm::u8vec3(255, 0, 0));
  for (const glm::u8vec3 texel : patches[1].colours.texels)
    EXPECT_EQ(texel, glm::u8vec3(0, 0, 255));
}

TEST(TextureMaps, WhereThereIsNoMeshTheSurroundingsGoOn) {
  Points mesh;
  MeshMaterial red;
  red.colour = {1.0F, 0.0F, 0.0F};
  mesh.materials = {red};
  add_square(mesh, 0.0, true, 0, glm::dvec3(0.0));
  mesh.triangles.pop_back();
  mesh.triangle_materials.pop_back();
  std::vector<Patch> patches{square_patch(0.0, true, glm::dvec3(0.0))};
  ASSERT_TRUE(map_textures(mesh, 8, patches));
  for (const glm::u8vec3 texel : patches[0].colours.texels)
    EXPECT_EQ(texel, glm::u8vec3(255, 0, 0));
  // A mesh that is elsewhere: neutral grey, half the light.
  for (glm::dvec3& p : mesh.positions) p.z += 100.0;
  ASSERT_TRUE(map_textures(mesh, 8, patches));
  for (const glm::u8vec3 texel : patches[0].colours.texels) EXPECT_EQ(texel, glm::u8vec3(188));
}

TEST(TextureMaps, MoreTexelsThanAPatchHoldsAreRefused) {
  Points mesh;
  mesh.materials = {ramp(4)};
  add_square(mesh, 0.0, true, 0, glm::dvec3(0.0));
  std::vector<Patch> patches{square_patch(0.0, true, glm::dvec3(0.0))};
  patches[0].width = 300;
  patches[0].heights.assign(std::size_t{300} * 9, 0);
  const Status refused = map_textures(mesh, kMaxTexelsPerCell, patches);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("64 texels a cell"), std::string::npos);
}

TEST(TextureMaps, ConversionsOfFourVerticesHaveTheTextureAndDoNotDependOnThreads) {
  Points mesh;
  mesh.materials = {ramp(256)};
  add_square(mesh, 0.0, true, 0, glm::dvec3(0.0));
  ConvertOptions options;
  options.spacing = 0.02;
  Progress progress;
  options.threads = 1;
  const auto one = convert(mesh, options, progress);
  ASSERT_TRUE(one) << one.error().message;
  EXPECT_TRUE(one->model.has_colours);
  // 256 texels over 100 cells.
  EXPECT_EQ(one->report.texels_per_cell, 4U);
  options.threads = 3;
  const auto three = convert(mesh, options, progress);
  ASSERT_TRUE(three);
  ASSERT_EQ(one->model.patches.size(), three->model.patches.size());
  for (std::size_t p = 0; p < one->model.patches.size(); ++p) {
    const Patch& patch = one->model.patches[p];
    EXPECT_EQ(patch.heights, three->model.patches[p].heights);
    EXPECT_EQ(patch.colours.texels, three->model.patches[p].colours.texels);
    const auto& colours = patch.colours;
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 at =
            patch.origin + patch.axes * glm::dvec3(i * patch.spacing, j * patch.spacing, 0.0);
        if (std::max(std::abs(at.x), std::abs(at.y)) > 0.98) continue;
        const std::size_t k = std::size_t{j} * colours.scale * colours.width + i * colours.scale;
        // As above.
        EXPECT_NEAR(linear_from_srgb8(colours.texels[k]).r, 0.5 * at.x + 0.5, 0.0092);
      }
    }
  }
}

}  // namespace
}  // namespace relief

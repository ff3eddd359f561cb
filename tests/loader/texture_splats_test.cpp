// Splats that keep the texture of a mesh or of points.
#include "loader/models/texture_splats.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "common/mesh/mesh_texture.h"
#include "loader/load_scene.h"
#include "renderer/append.h"
#include "renderer/engine_registry.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief {
namespace {

/// An image of 8 x 8 texels: red grows to the right, green downward.
Image ramps() {
  Image image{8, 8, {}};
  for (const char* const name : {"R", "G", "B"})
    image.channels.push_back({name, ChannelType::Float, {}});
  for (int k = 0; k < 64; ++k) {
    image.channels[0].values.push_back(static_cast<float>(k % 8) / 7.0F);
    image.channels[1].values.push_back(static_cast<float>(k / 8) / 7.0F);
    image.channels[2].values.push_back(0.0F);
  }
  return image;
}

/// A square of 5 x 5 points as OBJ, with texture coordinates of their places. Triangles of the
/// right half have coordinates that are 0.5 lower: a seam at x = 2.
std::string square_obj(bool with_faces) {
  std::string obj;
  for (int k = 0; k < 25; ++k)
    obj += fmt::format("v {} {} 0\nvt {} {}\n", k % 5, k / 5, 0.25 * (k % 5), 0.25 * (k / 5));
  for (int k = 0; k < 25; ++k)
    obj += fmt::format("vt {} {}\n", 0.25 * (k % 5) - 0.5, 0.25 * (k / 5));
  for (int j = 0; with_faces && j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i + 1;
      const int t = i < 2 ? 0 : 25;
      obj += fmt::format("f {}/{} {}/{} {}/{} {}/{}\n", a, a + t, a + 1, a + 1 + t, a + 6,
                         a + 6 + t, a + 5, a + 5 + t);
    }
  }
  return obj;
}

class TexturedSplats : public testing::Test {
 protected:
  TexturedSplats() {
    for (const EngineEntry& engine : engines()) {
      if (engine.name != "ewa") continue;
      engines_.push_back(engine);
      engines_.back().capabilities.textures_splats = true;
    }
    EXPECT_TRUE(write_png(folder_ / "ramps.png", ramps()));
  }

  SplatCloud must_load(const std::string& name, const std::string& text) {
    test::spill(folder_ / name.c_str(), text);
    SceneSettings settings;
    settings.engine = "ewa";
    const auto plan = plan_scene(folder_ / name.c_str(), settings, engines_);
    EXPECT_TRUE(plan) << plan.error().message;
    LoadOptions options;
    options.textures.image = folder_ / "ramps.png";
    Progress progress;
    auto scene = load_scene(*plan, options, progress, engines_);
    if (scene && scene->splats) return std::move(*scene->splats);
    ADD_FAILURE() << (scene ? "no splats" : scene.error().message);
    return {};
  }

  test::ScratchFolder folder_;
  std::vector<EngineEntry> engines_;
};

TEST_F(TexturedSplats, HaveTheMeshsTexture) {
  const SplatCloud splats = must_load("square.obj", square_obj(true));
  ASSERT_TRUE(splats.texture);
  ASSERT_EQ(splats.positions.size(), 25U) << "no splats of the faces, as acquisition makes them";
  ASSERT_EQ(splats.texcoords.size(), 25U);
  ASSERT_EQ(splats.texture->width, 8U);
  for (std::size_t k = 0; k < 64; ++k) {
    // 8 bits of sRGB: steps are at most 0.009 in linear light, rounding half of that.
    EXPECT_NEAR(splats.texture->find("R")->values[k], static_cast<float>(k % 8) / 7.0F, 0.005F);
    EXPECT_NEAR(splats.texture->find("G")->values[k], static_cast<float>(k / 8) / 7.0F, 0.005F);
  }
  for (std::size_t k = 0; k < 25; ++k) {
    const glm::dvec3 p = splats.positions[k];
    // On the seam the first triangle's count, which are the left ones.
    const double u = 0.25 * p.x - (p.x > 2.5 ? 0.5 : 0.0);
    EXPECT_FLOAT_EQ(splats.texcoords[k].x, static_cast<float>(u)) << p.x;
    EXPECT_FLOAT_EQ(splats.texcoords[k].y, static_cast<float>(1.0 - 0.25 * p.y)) << "v downward";
  }
  ASSERT_EQ(splats.colours.size(), 25U) << "for engines that draw no textures";
}

TEST_F(TexturedSplats, PointsMayHaveATextureWithoutFaces) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 25\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nproperty float t\nend_header\n";
  for (int k = 0; k < 25; ++k)
    ply += fmt::format("{} {} 0 {} {}\n", k % 5, k / 5, 0.2 * (k % 5) + 0.1, 0.2 * (k / 5) + 0.1);
  const SplatCloud splats = must_load("points.ply", ply);
  ASSERT_TRUE(splats.texture);
  for (std::size_t k = 0; k < 25; ++k) {
    EXPECT_FLOAT_EQ(splats.texcoords[k].x, static_cast<float>(0.2 * splats.positions[k].x + 0.1));
    // Linear ramps of eight texels, whose first and last middles are at 1/16 and 15/16.
    const double red = (splats.texcoords[k].x * 8.0 - 0.5) / 7.0;
    EXPECT_NEAR(splats.colours[k].r, red, 0.01) << "8 bits of sRGB, twice";
  }
}

TEST_F(TexturedSplats, OfTwoTexturesTheCommonerIsKept) {
  const Image image = ramps();
  const auto texture =
      std::make_shared<const MeshTexture>(*MeshTexture::from_image(image, TextureWrap::Repeat));
  Points points;
  for (int k = 0; k < 8; ++k) points.positions.emplace_back(k, k % 2, 0);
  points.texcoords.assign(8, glm::vec2(0.5F, 0.25F));
  points.triangles = {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}};
  MeshMaterial plain;
  plain.colour = {0.0F, 0.0F, 1.0F};
  MeshMaterial textured;
  textured.texture = texture;
  textured.colour = {0.5F, 1.0F, 1.0F};
  points.materials = {plain, textured};
  points.triangle_materials = {1, 1, 0};
  SplatCloud cloud;
  cloud.positions = points.positions;
  texture_splats(points, cloud);
  ASSERT_TRUE(cloud.texture);
  EXPECT_NEAR(cloud.texture->find("R")->values[7], 0.5F, 1e-5F) << "times the material's colour";
  EXPECT_EQ(cloud.texcoords[3], glm::vec2(0.5F, 0.75F));
  EXPECT_TRUE(std::isnan(cloud.texcoords[4].x)) << "of the plain material";
  EXPECT_EQ(cloud.colours[4], glm::vec4(0, 0, 1, 1));
  EXPECT_TRUE(std::isnan(cloud.texcoords[7].x)) << "of no triangle";
  EXPECT_EQ(cloud.colours[7].r, cloud.colours[7].b) << "grey";

  SplatCloud other = cloud;
  other.texture = std::make_shared<const Image>(image);
  SplatCloud same = cloud;
  append(cloud, std::move(same), 0);
  append(cloud, std::move(other), 0);
  ASSERT_EQ(cloud.texcoords.size(), 24U);
  EXPECT_EQ(cloud.texcoords[8 + 3], glm::vec2(0.5F, 0.75F));
  EXPECT_TRUE(std::isnan(cloud.texcoords[16 + 3].x)) << "on another texture: its colour stands";
}

}  // namespace
}  // namespace relief

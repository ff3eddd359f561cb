// The surroundings as the CPU looks them up: directions, edges, convention, and against OpenGL.
#include "renderer/shading/environment/cube_map.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <random>

#include "common/image/image_io.h"
#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using test::values;

/// A cube whose texels are `light(direction of the texel's middle)`.
template <class Light>
CubeMap make_cube(std::uint32_t size, const Light& light) {
  CubeMap cube;
  cube.size = size;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::uint32_t y = 0; y < size; ++y) {
      for (std::uint32_t x = 0; x < size; ++x) {
        const glm::dvec2 st = 2.0 * (glm::dvec2(x, y) + 0.5) / double{1.0 * size} - 1.0;
        cube.faces[face].push_back(light(cube_direction(face, st)));
      }
    }
  }
  return cube;
}

float largest(glm::vec3 v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(CubeMap, FacesAreWhereOpenGlHasThem) {
  const std::vector<glm::dvec3> axes{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  CubeMap cube;
  cube.size = 1;
  for (std::size_t face = 0; face < 6; ++face) {
    cube.faces[face] = {glm::vec3(static_cast<float>(face))};
    EXPECT_EQ(cube_direction(face, {0.0, 0.0}), axes[face]);
  }
  for (std::size_t face = 0; face < 6; ++face)
    EXPECT_EQ(look_up(cube, 7.0 * axes[face]).x, static_cast<float>(face));
  // OpenGL 4.5, table 8.19: s along -Z and t along -Y on +X; s along +X and t along +Z on +Y.
  EXPECT_EQ(cube_direction(0, {0.25, 0.5}), glm::dvec3(1.0, -0.5, -0.25));
  EXPECT_EQ(cube_direction(2, {0.25, 0.5}), glm::dvec3(0.25, 1.0, 0.5));
}

TEST(CubeMap, LookupsWithinAFaceAreBilinear) {
  // Directions on the cube are linear in (s, t), which bilinear lookups reproduce.
  const CubeMap cube = make_cube(8, [](glm::dvec3 d) { return glm::vec3(d); });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> inside(-0.87,
                                                0.87);  // up to the outermost texels' middles
  for (std::size_t face = 0; face < 6; ++face) {
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 d = cube_direction(face, {inside(random), inside(random)});
      EXPECT_LT(largest(look_up(cube, 3.0 * d) - glm::vec3(d)), 1e-6F);
    }
  }
}

TEST(CubeMap, EdgesAreSeamless) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> light(0.0F, 1.0F);
  const CubeMap cube =
      make_cube(4, [&](glm::dvec3) { return glm::vec3(light(random), light(random), 0.0F); });
  // All twelve edges: two coordinates of size 1, the third along the edge up to the last texel.
  for (glm::length_t along = 0; along < 3; ++along) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        for (double t = -0.75; t <= 0.75; t += 0.05) {
          glm::dvec3 one;
          one[along] = t;
          one[(along + 1) % 3] = a;
          one[(along + 2) % 3] = b * (1.0 - 1e-9);
          glm::dvec3 other = one;
          other[(along + 1) % 3] = a * (1.0 - 1e-9);
          other[(along + 2) % 3] = b;
          // Without the neighbour's texels the two faces' values are random, 0.3 apart on average.
          EXPECT_LT(largest(look_up(cube, one) - look_up(cube, other)), 1e-5F)
              << along << " " << a << " " << b << " " << t;
        }
      }
    }
  }
}

/// An equirectangular file whose light is 0.5 + 0.5 times the direction.
class Panorama : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() /
            ("relief-panorama-" + std::to_string(::getpid()) + ".exr");
    constexpr std::size_t kWidth = 128;
    constexpr std::size_t kHeight = 64;
    Image image{kWidth, kHeight, {}};
    for (const char* name : {"R", "G", "B"})
      image.channels.push_back({name, ChannelType::Float, std::vector<float>(kWidth * kHeight)});
    for (std::size_t y = 0; y < kHeight; ++y) {
      for (std::size_t x = 0; x < kWidth; ++x) {
        // Longitude 0 in the middle is -Z, to the right is +X; latitude from +Y down.
        const double longitude =
            ((static_cast<double>(x) + 0.5) / kWidth - 0.5) * glm::two_pi<double>();
        const double polar = (static_cast<double>(y) + 0.5) / kHeight * glm::pi<double>();
        const glm::dvec3 d(std::sin(polar) * std::sin(longitude), std::cos(polar),
                           -std::sin(polar) * std::cos(longitude));
        for (glm::length_t c = 0; c < 3; ++c)
          image.channels[static_cast<std::size_t>(c)].values[y * kWidth + x] =
              static_cast<float>(0.5 + 0.5 * d[c]);
      }
    }
    ASSERT_TRUE(write_exr(path_, image));
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_;
};

TEST_F(Panorama, LiesAroundTheEyeAsTheConventionSays) {
  const auto cube = load_environment(path_);
  ASSERT_TRUE(cube) << cube.error().message;
  std::mt19937 random(3);
  std::normal_distribution<double> any;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
    // Bilinear twice along both axes, at steps h of 0.05 and of 0.03 radians (64 texels a face), of
    // functions that bend by 0.5: h^2 / 8 is 3.0e-4 and 1.2e-4.
    double tolerance = 4.5e-4;
    // Half a texel from a face's edge the next face's nearest texel counts up to a half; it is off
    // by up to half a texel, with a slope of 0.5.
    const glm::dvec3 a = glm::abs(d);
    const double first = std::max({a.x, a.y, a.z});
    const double second = a.x + a.y + a.z - first - std::min({a.x, a.y, a.z});
    if (second > first * (1.0 - 1.0 / 64.0)) tolerance += 0.5 * 0.5 / 64.0;
    // At the poles the image's last row, half a step away, is repeated.
    if (glm::length(glm::dvec2(d.x, d.z)) < 0.1) tolerance += 0.5 * 0.025;
    EXPECT_LT(largest(look_up(*cube, d) - glm::vec3(0.5 + 0.5 * d)), tolerance)
        << d.x << " " << d.y << " " << d.z;
  }
}

TEST_F(Panorama, IsBehindTheModelAsOpenGlDrawsIt) {
  // Six faces, edges and corners of the cube; no model in front.
  const std::vector<glm::dvec3> directions{{1, 0, 0},   {-1, 0, 0}, {0, 1, 0},  {0, -1, 0},
                                           {0, 0, 1},   {0, 0, -1}, {1, 1, 0},  {-1, 0, 1},
                                           {0, -1, -1}, {1, 1, 1},  {-1, 1, -1}};
  for (const glm::dvec3& direction : directions) {
    RenderSettings settings = test::traced_image(
        {{1, 2, 3}, glm::dvec3(1, 2, 3) + direction, {0.1, 1, 0.2}, 25.0}, 64, 48);
    settings.background = glm::vec3(0.0F);
    settings.environment = path_;
    const Image traced = test::must_render(PatchModel{}, settings).image;
    settings.engine = "onepass";
    const Image drawn = test::must_render(PatchModel{}, settings).image;
    for (const char* channel : {"R", "G", "B"}) {
      double worst = 0.0;
      for (std::size_t k = 0; k < values(drawn, channel).size(); ++k)
        worst = std::max(worst,
                         double{std::abs(values(drawn, channel)[k] - values(traced, channel)[k])});
      // OpenGL keeps half floats, which are 4.9e-4 apart below 1: rounded when uploaded, cut off
      // when drawn; and filters with weights in steps of 1/256 of the 0.016 between texels.
      EXPECT_LT(worst, 1.5 * 4.9e-4 + 0.016 / 256)
          << channel << " " << direction.x << " " << direction.y << " " << direction.z;
    }
  }
}

/// A face of a cross as someone within the cube sees it.
struct Panel {
  int column;
  int row;
  glm::dvec3 forward;
  glm::dvec3 right;
  glm::dvec3 up;
};

/// The light of a direction, smooth and different for each.
glm::vec3 cube_tint(glm::dvec3 direction) {
  return glm::vec3(0.5 + 0.25 * glm::normalize(direction));
}

/// Whoever turns from the middle panel to a panel beside it sees it continue: the head turns right,
/// left, up, down, and once more to what is behind.
std::vector<Panel> panels_of(bool wide) {
  const glm::dvec3 x(1, 0, 0);
  const glm::dvec3 y(0, 1, 0);
  const glm::dvec3 z(0, 0, 1);
  return {{1, 1, -z, x, y},  {2, 1, x, z, y},
          {0, 1, -x, -z, y}, {1, 0, y, x, z},
          {1, 2, -y, x, -z}, wide ? Panel{3, 1, z, -x, y} : Panel{1, 3, z, x, -y}};
}

class Crosses : public testing::TestWithParam<std::tuple<bool, std::uint32_t>> {};

TEST_P(Crosses, AreAsSeenFromWithin) {
  const auto [wide, size] = GetParam();
  Image image{(wide ? 4 : 3) * size, (wide ? 3 : 4) * size, {}};
  for (const char* name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Float,
                              std::vector<float>(std::size_t{image.width} * image.height, 9.0F)});
  }
  for (const Panel& panel : panels_of(wide)) {
    for (std::uint32_t j = 0; j < size; ++j) {
      for (std::uint32_t i = 0; i < size; ++i) {
        const glm::dvec2 at = (2.0 * glm::dvec2(i, j) + 1.0) / double{1.0 * size} - 1.0;
        const glm::vec3 light = cube_tint(panel.forward + at.x * panel.right - at.y * panel.up);
        const std::size_t k =
            (panel.row * size + j) * std::size_t{image.width} + panel.column * size + i;
        for (std::size_t c = 0; c < 3; ++c)
          image.channels[c].values[k] = light[static_cast<glm::length_t>(c)];
      }
    }
  }
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("relief-cross-" + std::to_string(::getpid()) + ".exr");
  ASSERT_TRUE(write_exr(path, image));
  const auto cube = load_environment(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(cube) << cube.error().message;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 direction(normal(random), normal(random), normal(random));
    // Across a face the light changes by 0.25 in 32 texels or more; over an edge of the cube, where
    // texels meet at an angle, bilinear lookups are off by a part of a texel.
    EXPECT_LT(largest(look_up(*cube, direction) - cube_tint(direction)), 0.005F)
        << direction.x << " " << direction.y << " " << direction.z;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Crosses,
                         testing::Combine(testing::Bool(), testing::Values(32U, 48U)));

}  // namespace
}  // namespace relief

// Environments of six files: which files, where their faces lie, and what is wrong with some.
#include "renderer/shading/environment/environment_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <random>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "renderer/shading/environment/cube_map.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

using FaceNames = std::array<const char*, 6>;

constexpr FaceNames kShort{"px", "nx", "py", "ny", "pz", "nz"};
constexpr FaceNames kLong{"posx", "negx", "posy", "negy", "posz", "negz"};
constexpr FaceNames kWords{"right", "left", "top", "bottom", "front", "back"};

/// The light of a direction: the direction itself, as a colour.
glm::vec3 tint(glm::dvec3 direction) {
  return glm::vec3(0.5 + 0.5 * glm::normalize(direction));
}

/// An image whose colour is `light(x, y)` at the pixels' middles in [0, 1], y downward.
Image image_of(std::uint32_t width, std::uint32_t height,
               const std::function<glm::vec3(double, double)>& light) {
  Image image{width, height, {}};
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, ChannelType::Float, {}});
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::vec3 colour = light((x + 0.5) / width, (y + 0.5) / height);
      for (glm::length_t c = 0; c < 3; ++c)
        image.channels[static_cast<std::size_t>(c)].values.push_back(colour[c]);
    }
  }
  return image;
}

/// What a camera sees over 90 degrees that stands in the middle.
struct EnvironmentLook {
  glm::dvec3 forward;
  glm::dvec3 right;
  glm::dvec3 up;
};

/// Whoever looks ahead (-Z) turns to the right, to the left, raises the head, lowers it, does
/// nothing, turns around.
const std::array<EnvironmentLook, 6> kLooks{{{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                             {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                             {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                             {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}}}};

class SixFaces : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("relief-faces-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path pattern() const { return folder_ / "sky_{face}.exr"; }
  [[nodiscard]] fs::path file(const char* name) const {
    return folder_ / ("sky_" + std::string(name) + ".exr");
  }

  void write_faces(const FaceNames& names, std::uint32_t size) const {
    for (std::size_t face = 0; face < 6; ++face) {
      const EnvironmentLook& look = kLooks[face];
      const Image seen = image_of(size, size, [&look](double x, double y) {
        return tint(look.forward + (2.0 * x - 1.0) * look.right - (2.0 * y - 1.0) * look.up);
      });
      ASSERT_TRUE(write_exr(file(names[face]), seen));
    }
  }

  /// What load_environment says about the files that are there.
  [[nodiscard]] std::string fault() const {
    const auto cube = load_environment(pattern());
    return cube ? "no error" : cube.error().message;
  }

  fs::path folder_;
};

/// The largest difference of two environments' light over directions all around.
template <class One, class Other>
float difference(const One& one, const Other& other) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  float worst = 0.0F;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 direction(normal(random), normal(random), normal(random));
    const glm::vec3 off = glm::abs(one(direction) - other(direction));
    worst = std::max({worst, off.x, off.y, off.z});
  }
  return worst;
}

TEST_F(SixFaces, AreAsSeenFromWithinUnderEachSetOfNames) {
  for (const FaceNames& names : {kShort, kLong, kWords}) {
    for (const std::uint32_t size : {64U, 96U}) {  // as it is, and resampled to 128
      write_faces(names, size);
      const auto cube = load_environment(pattern());
      ASSERT_TRUE(cube) << cube.error().message;
      EXPECT_EQ(cube->size, size == 64U ? 64U : 128U);
      // Over an edge of the cube the nearest texel of the next face counts up to a half, and is off
      // by up to half a texel of 1/32 with a slope of 0.5. A face that is mirrored, turned or
      // exchanged for another is off by 0.7 and more.
      EXPECT_LT(difference([&](glm::dvec3 d) { return look_up(*cube, d); }, tint),
                0.5 * 0.5 * 0.5 / 32.0)
          << names[0] << " " << size;
    }
    for (const char* name : names) fs::remove(file(name));
  }
}

TEST_F(SixFaces, AreTheSameAsAnEquirectangularImage) {
  write_faces(kShort, 64);
  const fs::path panorama = folder_ / "panorama.exr";
  ASSERT_TRUE(write_exr(panorama, image_of(256, 128, [](double x, double y) {
                          const double longitude = (x - 0.5) * glm::two_pi<double>();
                          const double polar = y * glm::pi<double>();
                          return tint({std::sin(polar) * std::sin(longitude), std::cos(polar),
                                       -std::sin(polar) * std::cos(longitude)});
                        })));
  const auto faces = load_environment(pattern());
  const auto whole = load_environment(panorama);
  ASSERT_TRUE(faces && whole);
  // Their texels have the same middles. The panorama's last row, half a step of 0.025 radians from
  // the pole, is repeated there, with a slope of 0.5.
  EXPECT_LT(difference([&](glm::dvec3 d) { return look_up(*faces, d); },
                       [&](glm::dvec3 d) { return look_up(*whole, d); }),
            0.5 * 0.5 * 0.025);
}

TEST_F(SixFaces, TheNamesOfTheSetThatExistsAreUsed) {
  write_faces(kWords, 8);
  ASSERT_TRUE(write_exr(file("px"), image_of(4, 4, [](double, double) { return glm::vec3(0); })));
  const auto files = environment_files(pattern());
  ASSERT_TRUE(files) << files.error().message;
  ASSERT_EQ(files->size(), 6U);
  EXPECT_EQ(files->front(), file("right"));
  EXPECT_EQ(files->back(), file("back"));
  // Only a file's name is a pattern.
  const auto plain = environment_files(folder_ / "{face}" / "sky.exr");
  ASSERT_TRUE(plain);
  EXPECT_EQ(*plain, std::vector<fs::path>{folder_ / "{face}" / "sky.exr"});
}

TEST_F(SixFaces, ThatDoNotFitAreNamed) {
  EXPECT_NE(fault().find("sky_{face}.exr: there is no file of any face"), std::string::npos);
  write_faces(kShort, 8);
  const auto grey = [](double, double) { return glm::vec3(0.5F); };
  ASSERT_TRUE(write_exr(file("ny"), image_of(8, 4, grey)));
  EXPECT_NE(fault().find("sky_ny.exr: its 8x4 pixels are not square"), std::string::npos);
  ASSERT_TRUE(write_exr(file("ny"), image_of(4, 4, grey)));
  EXPECT_NE(fault().find("sky_ny.exr: its 4x4 pixels are not the 8x8 of"), std::string::npos);
  Image colourless = image_of(8, 8, grey);
  for (Channel& channel : colourless.channels) channel.name += ".x";
  ASSERT_TRUE(write_exr(file("ny"), colourless));
  EXPECT_NE(fault().find("sky_ny.exr: has no colour"), std::string::npos);
  fs::remove(file("ny"));
  EXPECT_NE(fault().find("sky_ny.exr: there is no such file"), std::string::npos);
}

}  // namespace
}  // namespace relief

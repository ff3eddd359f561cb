// Normal maps that the material files of OBJ meshes name.
#include "preprocess/texture/files/load_normal_maps.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "common/mesh/normal_texture.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/files/load_textures.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

const std::string kTriangle =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n";

class LoadNormalMaps : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("relief_load_normals_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write("a.obj", kTriangle);
    // A pixel whose stored bytes are 204, 128, 230.
    Image image{1, 1, {}};
    const std::uint8_t codes[] = {204, 128, 230};
    for (std::size_t c = 0; c < 3; ++c)
      image.channels.push_back(
          {std::string(1, "RGB"[c]), ChannelType::Float, {linear_from_srgb8(codes[c])}});
    ASSERT_TRUE(write_png(folder_ / "tilt map.png", image));
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  /// Reads a.obj with this material file; what went wrong, if anything did.
  std::string load(const std::string& mtl, const TextureChoice& choice = {}) {
    write("a.mtl", mtl);
    Progress progress;
    auto read = read_points(folder_ / "a.obj", progress);
    if (!read) return read.error().message;
    points_ = std::move(read->points);
    notes_.clear();
    const Status loaded = load_textures(folder_ / "a.obj", choice, points_, notes_);
    return loaded ? std::string() : loaded.error().message;
  }

  fs::path folder_;
  Points points_;
  std::vector<std::string> notes_;
};

TEST_F(LoadNormalMaps, NormAndMapKnAreReadAsStored) {
  for (const char* keyword : {"norm", "map_Kn", "map_kn"}) {
    ASSERT_EQ(load("newmtl m\nKd 1 0 0\n" + std::string(keyword) + " -bm 0.5 tilt map.png\n"), "");
    EXPECT_TRUE(notes_.empty());
    const MeshNormalMap& map = points_.materials.at(0).normals;
    ASSERT_NE(map.texture, nullptr) << keyword;
    EXPECT_EQ(map.scale, 0.5F);
    const glm::vec3 expected = glm::normalize(2.0F * glm::vec3(204, 128, 230) / 255.0F - 1.0F);
    // 16 bits.
    EXPECT_LT(glm::distance(map.texture->at({0.5F, 0.5F}), expected), 4e-5F);
    EXPECT_EQ(points_.materials[0].colour, glm::vec3(1.0F, 0.0F, 0.0F));
  }
}

TEST_F(LoadNormalMaps, MissingAndDamagedOnesAreNamed) {
  EXPECT_NE(load("newmtl m\nnorm gone.png\n").find("gone.png"), std::string::npos);
  EXPECT_NE(load("newmtl m\nnorm gone.png\n").find("normal map of material 'm'"),
            std::string::npos);
  write("gone.png", "no picture");
  EXPECT_NE(load("newmtl m\nnorm gone.png\n").find("gone.png"), std::string::npos);
  EXPECT_NE(load("newmtl m\nnorm -clamp on\n").find("line 2: norm names no file"),
            std::string::npos);
  // Without textures there is nothing to miss.
  EXPECT_EQ(load("newmtl m\nnorm gone.png\n", {true, {}}), "");
}

TEST_F(LoadNormalMaps, ImagesOfImpossibleSizesAreNamed) {
  std::ifstream file(folder_ / "tilt map.png", std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(file)), {});
  // PNG's width and height are bytes 16 to 23. libpng sees wrong checksums; either way it is one
  // sentence with the name.
  for (const char* size : {"\0\0\0\0\0\0\0\1", "\0\0\0\1\0\0\0\0", "\x7F\xFF\xFF\xFF\0\1\0\0"}) {
    std::string bad = good;
    bad.replace(16, 8, std::string(size, 8));
    write("bad.png", bad);
    const std::string message = load("newmtl m\nnorm bad.png\n");
    EXPECT_NE(message.find("bad.png"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  // Radiance files have no checksums: sizes are seen for what they are.
  for (const char* size : {"-Y 0 +X 5", "-Y 5 +X 0", "-Y 60000 +X 60000"}) {
    write("bad.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + std::string(size) + "\n1234");
    EXPECT_NE(load("newmtl m\nnorm bad.hdr\n").find("bad.hdr"), std::string::npos) << size;
  }
}

TEST_F(LoadNormalMaps, HeightMapsAreANote) {
  for (const char* keyword : {"map_Bump", "bump", "map_bump"}) {
    ASSERT_EQ(load("newmtl m\n" + std::string(keyword) + " -bm 0.2 gone.png\n"), "");
    ASSERT_EQ(notes_.size(), 1U) << keyword;
    EXPECT_NE(notes_[0].find("holds heights"), std::string::npos);
    EXPECT_EQ(points_.materials.at(0).normals.texture, nullptr);
  }
  // Beside a normal map they say nothing more.
  ASSERT_EQ(load("newmtl m\nnorm tilt map.png\nmap_Bump gone.png\n"), "");
  EXPECT_TRUE(notes_.empty());
  EXPECT_NE(points_.materials.at(0).normals.texture, nullptr);
}

TEST_F(LoadNormalMaps, UnreadOptionsAreANoteAndNamesDoNotLeadOutOfTheFolder) {
  ASSERT_EQ(load("newmtl m\nnorm -s 2 2 ../elsewhere/tilt map.png\n"), "");
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("-s is not read"), std::string::npos);
  EXPECT_NE(points_.materials.at(0).normals.texture, nullptr);
}

}  // namespace
}  // namespace relief

// OBJ meshes with their material files and images.
#include "preprocess/texture/files/load_textures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "common/mesh/mesh_texture.h"
#include "preprocess/readers/read_points.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

const std::string kTexturedSquare =
    "mtllib my colours.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
    "usemtl of paint\nf 1/1 2/2 3/3\nusemtl plain\nf 1 3 4\n";

class LoadTextures : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("relief_load_textures_" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "mesh" / "deeper");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// One pixel.
  void write_image(const std::string& name, glm::vec3 colour) const {
    Image image{1, 1, {}};
    for (glm::length_t c = 0; c < 3; ++c)
      image.channels.push_back({std::string(1, "RGB"[c]), ChannelType::Float, {colour[c]}});
    ASSERT_TRUE(write_png(folder_ / name, image));
  }
  /// Reads mesh/a.obj; `points_`, `notes_` and what went wrong, if anything did.
  std::string load(const TextureChoice& choice = {}) {
    Progress progress;
    auto read = read_points(folder_ / "mesh" / "a.obj", progress);
    if (!read) return read.error().message;
    points_ = std::move(read->points);
    notes_.clear();
    const Status loaded = load_textures(folder_ / "mesh" / "a.obj", choice, points_, notes_);
    return loaded ? std::string() : loaded.error().message;
  }
  [[nodiscard]] glm::vec3 colour_of(std::size_t triangle) const {
    const MeshMaterial& material = points_.materials.at(points_.triangle_materials.at(triangle));
    return material.texture == nullptr ? material.colour : material.texture->at({0.5F, 0.5F});
  }

  fs::path folder_;
  Points points_;
  std::vector<std::string> notes_;
};

TEST_F(LoadTextures, NamesWithBlanksAndOptionsLeadToImages) {
  write("mesh/a.obj", kTexturedSquare);
  write("mesh/my colours.mtl",
        "newmtl of paint\r\nKd 0 0 0\r\nmap_Kd -o 0 0 -s 1 1 1 -clamp on deeper\\red paint.png\r\n"
        "newmtl plain\nKd 0.5 1 0\n");
  write_image("mesh/deeper/red paint.png", {1.0F, 0.0F, 0.0F});
  ASSERT_EQ(load(), "");
  EXPECT_TRUE(notes_.empty());
  // The image replaces Kd, which is black.
  EXPECT_EQ(colour_of(0), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(colour_of(1), glm::vec3(linear_from_srgb(0.5F), 1.0F, 0.0F));
}

constexpr const char* kUnnamedSquare =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 0.75\nf 1/1 2/2 3/3\n";

TEST_F(LoadTextures, AMeshThatCouldHaveAPictureSaysHowToNameIt) {
  write("mesh/a.obj", kUnnamedSquare);
  ASSERT_EQ(load(), "");
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("a.obj: has texture coordinates, and no picture"), std::string::npos);
  EXPECT_NE(notes_[0].find("--texture FILE"), std::string::npos);
  // No note where the user has decided, or where there are no coordinates.
  write_image("blue.png", {0.0F, 0.0F, 1.0F});
  ASSERT_EQ(load({false, folder_ / "blue.png"}), "");
  EXPECT_TRUE(notes_.empty());
  ASSERT_EQ(load({true, {}}), "");
  EXPECT_TRUE(notes_.empty());
  write("mesh/a.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
  ASSERT_EQ(load(), "");
  EXPECT_TRUE(notes_.empty());
}

TEST_F(LoadTextures, CoordinatesThatCountDownwardAreTurned) {
  write("mesh/a.obj", kUnnamedSquare);
  write_image("blue.png", {0.0F, 0.0F, 1.0F});
  ASSERT_EQ(load({false, folder_ / "blue.png", true}), "");
  EXPECT_EQ(texcoords_of(points_, 0),
            (CornerTexcoords{{{0.0F, 1.0F}, {1.0F, 1.0F}, {1.0F, 0.25F}}}));
  Points both;
  both.corner_texcoords = {{{{0.0F, 0.25F}, {1.0F, 0.5F}, {2.0F, -1.0F}}}};
  both.corner_tangents = {{{{1, 0, 0, 1}, {1, 0, 0, -1}, {1, 0, 0, 0}}}};
  flip_v(both);
  EXPECT_EQ(both.corner_texcoords[0],
            (CornerTexcoords{{{0.0F, 0.75F}, {1.0F, 0.5F}, {2.0F, 2.0F}}}));
  EXPECT_EQ(both.corner_tangents[0][0].w, -1.0F);
  EXPECT_EQ(both.corner_tangents[0][1].w, 1.0F);
}

TEST_F(LoadTextures, PicturesThatAMeshFileNamesAreBesideIt) {
  write_image("mesh/deeper/red paint.png", {1.0F, 0.0F, 0.0F});
  const auto give = [&](const std::string& image) {
    points_ = {};
    points_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    points_.texcoords = {{0, 0}, {1, 0}, {0, 1}};
    points_.triangles = {{0, 1, 2}};
    points_.materials.resize(1);
    points_.materials[0].image = image;
    points_.materials[0].is_stated = true;
    points_.triangle_materials = {0};
    const Status loaded = load_textures(folder_ / "mesh" / "a.ply", {}, points_, notes_);
    return loaded ? std::string() : loaded.error().message;
  };
  EXPECT_EQ(give("deeper\\red paint.png"), "");
  EXPECT_EQ(colour_of(0), glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_NE(give("gone.png").find("mesh/gone.png"), std::string::npos);
  EXPECT_NE(give("gone.png").find("--texture names another"), std::string::npos);
  // Not a way to make Relief read other files.
  EXPECT_NE(give("/etc/passwd").find("mesh/passwd"), std::string::npos);
}

TEST_F(LoadTextures, MissingAndDamagedImagesAreNamed) {
  write("mesh/a.obj", kTexturedSquare);
  write("mesh/my colours.mtl", "newmtl of paint\nmap_Kd gone.png\n");
  EXPECT_NE(load().find("gone.png"), std::string::npos);
  write("mesh/gone.png", "no picture");
  EXPECT_NE(load().find("gone.png"), std::string::npos);
  write("mesh/my colours.mtl", "newmtl of paint\nmap_Kd -clamp on\n");
  EXPECT_NE(load().find("line 2: map_Kd names no file"), std::string::npos);
  // Without textures there is nothing to miss.
  EXPECT_EQ(load({true, {}}), "");
  EXPECT_FALSE(has_triangle_colours(points_));
}

TEST_F(LoadTextures, AMissingMaterialFileIsANoteAndAnUnreadOptionToo) {
  write("mesh/a.obj", kTexturedSquare);
  EXPECT_EQ(load(), "");
  ASSERT_EQ(notes_.size(), 2U);  // "my" and "colours.mtl": a line may name several
  EXPECT_NE(notes_[1].find("colours.mtl"), std::string::npos);
  EXPECT_FALSE(has_triangle_colours(points_));
  write("mesh/my colours.mtl", "newmtl of paint\nmap_Kd -s 2 2 red.png\n");
  write_image("mesh/red.png", {1.0F, 0.0F, 0.0F});
  EXPECT_EQ(load(), "");
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("-s is not read"), std::string::npos);
}

TEST_F(LoadTextures, NamesDoNotLeadOutOfTheFolder) {
  write_image("secret.png", {0.0F, 1.0F, 0.0F});
  write("mesh/a.obj", kTexturedSquare);
  for (const std::string& name : {std::string("../secret.png"), (folder_ / "secret.png").string(),
                                  std::string("deeper/../../secret.png"),
                                  std::string("..\\secret.png"), std::string("C:\\secret.png")}) {
    fs::remove(folder_ / "mesh" / "secret.png");
    write("mesh/my colours.mtl", "newmtl of paint\nmap_Kd " + name + "\n");
    EXPECT_NE(load().find("secret.png"), std::string::npos) << name;
    // Of the same name beside the mesh it is what the mesh's author meant.
    write_image("mesh/secret.png", {0.0F, 0.0F, 1.0F});
    EXPECT_EQ(load(), "") << name;
    EXPECT_EQ(colour_of(0), glm::vec3(0.0F, 0.0F, 1.0F)) << name;
  }
}

TEST_F(LoadTextures, AMeshWithoutMaterialsStaysAsItIs) {
  write("mesh/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(load(), "");
  EXPECT_TRUE(notes_.empty());
  EXPECT_EQ(points_.triangles.size(), 1U);
  EXPECT_TRUE(points_.triangle_materials.empty());
}

TEST_F(LoadTextures, OneTextureForAll) {
  write_image("blue.png", {0.0F, 0.0F, 1.0F});
  write("mesh/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(load({false, folder_ / "blue.png"}), "");
  EXPECT_EQ(colour_of(0), glm::vec3(0.0F, 0.0F, 1.0F));
  write("mesh/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(load({false, folder_ / "blue.png"}).find("no texture coordinates"), std::string::npos);
}

TEST_F(LoadTextures, NanTextureCoordinatesHaveNoColour) {
  write_image("mesh/red.png", {1.0F, 0.0F, 0.0F});
  write("mesh/my colours.mtl", "newmtl of paint\nmap_Kd red.png\n");
  std::string broken = kTexturedSquare;
  broken.replace(broken.find("vt 1 0"), 6, "vt nan 0");
  write("mesh/a.obj", broken);
  EXPECT_EQ(load(), "");
  EXPECT_FALSE(has_triangle_colours(points_));
}

}  // namespace
}  // namespace relief

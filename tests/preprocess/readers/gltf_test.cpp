// glTF: geometry in its place, materials, and files that are not to be trusted.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/common/patch_file/sample_models.h"
#include "tests/preprocess/readers/gltf_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief {
namespace {

using test::base64;
using test::document;
using test::embedded;
using test::kNode;
using test::triangle_bytes;

void expect_triangle(const Points& points) {
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points.positions[1], glm::dvec3(1.0, 0.0, 0.0));
  ASSERT_EQ(points.triangles.size(), 1U);
  EXPECT_EQ(points.triangles[0], (Triangle{0, 1, 2}));
  ASSERT_EQ(points.texcoords.size(), 3U);
  // v goes up here and down in the file.
  EXPECT_EQ(points.texcoords[2], glm::vec2(0.0F, 0.0F));
  EXPECT_EQ(points.texcoords[0], glm::vec2(0.0F, 1.0F));
  ASSERT_EQ(points.triangle_materials.size(), 1U);
  EXPECT_EQ(points.materials[points.triangle_materials[0]].colour, glm::vec3(1.0F, 0.5F, 0.0F));
}

/// The document with vertex colours as bytes instead of texture coordinates.
std::string coloured(const std::string& factor) {
  std::string text = embedded();
  const auto put = [&text](const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    ASSERT_NE(at, text.npos) << what;
    text.replace(at, what.size(), by);
  };
  const std::string bytes = triangle_bytes();
  const std::string colours = std::string("\xFF\x00\x37\x00\x00\xFF\x00\x00\x01\x01\x01\x00", 12);
  put(base64(bytes), base64(bytes.substr(0, 36) + colours + bytes.substr(48)));
  put(R"("componentType": 5126, "count": 3, "type": "VEC2")",
      R"("componentType": 5121, "normalized": true, "count": 3, "type": "VEC4")");
  put("TEXCOORD_0", "COLOR_0");
  put("[1, 0.5, 0, 1]", factor);
  return text;
}

TEST(Gltf, ColoursOfVerticesCountWhereMaterialsAreWhite) {
  const Points points = test::read("a.gltf", coloured("[1, 1, 1, 1]"));
  // Linear: 0x37 of 255 is 0.2157, which is sRGB 128.0.
  EXPECT_EQ(points.colours, (std::vector<glm::u8vec3>{{255, 0, 128}, {0, 255, 0}, {13, 13, 13}}));
  EXPECT_TRUE(points.materials.empty());
  EXPECT_TRUE(points.triangle_materials.empty());
  const Points tinted = test::read("a.gltf", coloured("[1, 0.5, 0, 1]"));
  EXPECT_TRUE(tinted.colours.empty());
  EXPECT_FALSE(tinted.materials.empty());
}

TEST(Gltf, TextAndBinaryAreTheSame) {
  expect_triangle(test::read("a.gltf", embedded()));
  expect_triangle(test::read("a.glb", test::binary_gltf()));
  expect_triangle(test::read("without_ending", test::binary_gltf()));
}

TEST(Gltf, BuffersAreReadBesideTheFileOnly) {
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder / "model");
  for (const char* name : {"outside.bin", "model/inside.bin"})
    std::ofstream(folder / name, std::ios::binary) << triangle_bytes();
  const std::string name = (folder / "model/a.gltf").string();
  const auto with_buffer = [](const std::string& uri) {
    return document(R"("uri": ")" + uri + "\", ", kNode);
  };
  expect_triangle(test::read(name, with_buffer("inside.bin")));
  for (const std::string& uri : {std::string("../outside.bin"), (folder / "outside.bin").string()})
    EXPECT_NE(test::error(name, with_buffer(uri)).find("File not found"), std::string::npos) << uri;
}

TEST(Gltf, NodesTransformMeshes) {
  const Points points =
      test::read("a.gltf", embedded(R"([{"children": [1, 2], "translation": [10, 0, 0]},
        {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]},
        {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}])"));
  ASSERT_EQ(points.size(), 6U);
  // In the order of the file's nodes from the last: the mirrored one, then the turned one.
  EXPECT_EQ(points.positions[1], glm::dvec3(9.0, 0.0, 5.0));
  // A quarter turn about z takes (2, 0) to (0, 2), up to rounding.
  EXPECT_NEAR(points.positions[4].x, 10.0, 1e-12);
  EXPECT_NEAR(points.positions[4].y, 2.0, 1e-12);
  // Mirrored triangles are turned round, so that both face up.
  for (const Triangle& t : points.triangles) {
    const glm::dvec3 a = points.positions[t[1]] - points.positions[t[0]];
    const glm::dvec3 b = points.positions[t[2]] - points.positions[t[0]];
    EXPECT_GT(a.x * b.y - a.y * b.x, 0.0);
  }
}

/// The document with a normal map on its material and, as accessor 3, tangents along +y.
std::string with_normal_map(const std::string& info, const std::string& nodes = kNode) {
  const std::string tangents =
      test::pack(0.F, 1.F, 0.F, -1.F, 0.F, 1.F, 0.F, -1.F) + test::pack(0.F, 1.F, 0.F, -1.F);
  const std::string bytes = triangle_bytes() + std::string(2, '\0') + tangents;
  std::string text =
      document(R"("uri": "data:application/octet-stream;base64,)" + base64(bytes) + "\", ", nodes);
  const auto change = [&text](const std::string& what, const std::string& instead) {
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
  };
  change(R"("byteLength": 66)", R"("byteLength": 116)");
  change(R"("byteLength": 6})",
         R"("byteLength": 6}, {"buffer": 0, "byteOffset": 68, "byteLength": 48})");
  change(
      R"("type": "SCALAR"})",
      R"("type": "SCALAR"}, {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC4"})");
  change(R"("TEXCOORD_0": 1)", R"("TEXCOORD_0": 1, "TANGENT": 3)");
  change(R"({"name": "m", )", R"({"name": "m", "normalTexture": )" + info + ", ");
  change(R"("materials")",
         R"("textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,AAAA"}],
    "materials")");
  return text;
}

TEST(Gltf, MaterialsHaveNormalMapsAndPointsTangents) {
  const Points points = test::read("a.gltf", with_normal_map(R"({"index": 0, "scale": 0.25})"));
  const MeshNormalMap& map = points.materials.at(points.triangle_materials.at(0)).normals;
  ASSERT_NE(map.image_bytes, nullptr);
  EXPECT_EQ(map.image_bytes->size(), 3U);
  EXPECT_EQ(map.scale, 0.25F);
  ASSERT_EQ(points.corner_tangents.size(), 1U);
  for (const glm::vec4 tangent : points.corner_tangents[0])
    EXPECT_EQ(tangent, glm::vec4(0.0F, 1.0F, 0.0F, -1.0F));
}

TEST(Gltf, MirroredNodesTurnTheHandednessOfTangents) {
  const Points points = test::read(
      "a.gltf",
      with_normal_map(R"({"index": 0})",
                      R"([{"mesh": 0, "matrix": [1,0,0,0, 0,-2,0,0, 0,0,1,0, 0,0,0,1]}])"));
  ASSERT_EQ(points.corner_tangents.size(), 1U);
  EXPECT_EQ(points.corner_tangents[0][0], glm::vec4(0.0F, -2.0F, 0.0F, 1.0F));
}

TEST(Gltf, NormalMapsWithTextureCoordinatesOfTheirOwnAreLeftOut) {
  const std::string base = R"("pbrMetallicRoughness": {)";
  std::string text = with_normal_map(R"({"index": 0, "texCoord": 1})");
  text.replace(text.find(base), base.size(), base + R"("baseColorTexture": {"index": 0}, )");
  const Points points = test::read("a.gltf", text);
  const MeshNormalMap& map = points.materials.at(points.triangle_materials.at(0)).normals;
  EXPECT_EQ(map.image_bytes, nullptr);
  EXPECT_NE(map.left_out.find("TEXCOORD_1"), std::string::npos);
  // A texture that does not exist is refused.
  EXPECT_NE(test::error("a.gltf", with_normal_map(R"({"index": 4})")), "no error");
}

TEST(Gltf, EveryTruncationIsRefused) {
  for (const auto& [name, whole] : {std::pair(std::string("a.gltf"), embedded()),
                                    std::pair(std::string("a.glb"), test::binary_gltf())}) {
    for (std::size_t length = 1; length < whole.size(); ++length)
      EXPECT_NE(test::error(name, whole.substr(0, length)), "no error") << length;
  }
}

TEST(Gltf, WhatPointsNowhereIsRefused) {
  const auto with = [](const std::string& what, const std::string& instead) {
    std::string text = embedded();
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), instead);
  };
  const std::pair<std::string, std::string> faults[] = {
      {R"("nodes": [0])", R"("nodes": [7])"},
      {R"([{"mesh": 0}])", R"([{"mesh": 9}])"},
      {R"([{"mesh": 0}])", R"([{"children": [0]}])"},
      {R"("POSITION": 0)", R"("POSITION": 12)"},
      {R"("POSITION": 0)", R"("POSITION": 1)"},
      {R"("count": 3, "type": "VEC3")", R"("count": 4000000000, "type": "VEC3")"},
      {R"("byteOffset": 36, "byteLength": 24)", R"("byteOffset": 60, "byteLength": 24)"},
      {R"({"buffer": 0, "byteLength": 36})", R"({"buffer": 3, "byteLength": 36})"},
      {R"("asset": {"version": "2.0"},)",
       R"("asset": {"version": "2.0"}, "extensionsRequired": ["KHR_draco_mesh_compression"],)"},
      {R"("baseColorFactor": [1, 0.5, 0, 1])", R"("baseColorTexture": {"index": 3})"}};
  for (const auto& [what, instead] : faults)
    EXPECT_NE(test::error("a.gltf", with(what, instead)), "no error") << instead;
  const std::string deep(100'000, '[');
  EXPECT_NE(test::error("a.gltf", deep).find("nests deeper"), std::string::npos);
}

// tinygltf 2.8 throws std::out_of_range for it.
TEST(Gltf, ABinaryFileWithABufferOfNoBytesIsRefused) {
  std::string file = test::binary_gltf();
  const std::string stated = R"("byteLength": 66)";
  const std::size_t at = file.find(stated);
  ASSERT_NE(at, std::string::npos);
  file.replace(at, stated.size(), R"("byteLength": 0 )");
  const std::string error = test::error("a.glb", file);
  EXPECT_TRUE(error.starts_with("a.glb: tinygltf failed to read it (")) << error;
  EXPECT_TRUE(error.ends_with("the file may be damaged: write it again, or convert it to PLY"))
      << error;
}

TEST(Gltf, BytesChangedAnywhereDoNoHarm) {
  for (const std::string& whole : {embedded(), test::binary_gltf()}) {
    for (std::size_t k = 0; k < whole.size(); ++k) {
      for (const char byte : {'\0', '9', '\xFF', '"'}) {
        std::string changed = whole;
        changed[k] = byte;
        // What comes of it does not matter, but that it comes.
        (void)test::try_read("a.gltf", changed);
      }
    }
  }
}

}  // namespace
}  // namespace relief

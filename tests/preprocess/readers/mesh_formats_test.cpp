#include <fmt/format.h>

#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjTest, KeepsDoublesAtUtmSize) {
  EXPECT_EQ(read("a.obj", "v 500000.123456789 4649776.000000001 -0.1\n").positions[0],
            dvec3(500000.123456789, 4649776.000000001, -0.1));
}

TEST(ObjTest, ReadsPolygonsNegativeIndicesContinuedLinesAndComments) {
  const std::vector<Triangle> expected = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(read("a.obj", kSquare + "f 1 2 3 4\n").triangles, expected);
  EXPECT_EQ(read("a.obj", kSquare + "f -4 -3 -2 -1\n").triangles, expected);
  EXPECT_EQ(read("a.obj", kSquare + "f 1 2 \\\n 3 \\\r\n 4 # four\n").triangles, expected);
  EXPECT_EQ(
      read("a.obj", "# head\nmtllib a.mtl\no square\n" + kSquare + "s off\nf 1 2 3 4\n").triangles,
      expected);
  EXPECT_EQ(read("a.obj", "f 1 2 3 4\n" + kSquare).triangles, expected) << "faces may come first";
}

TEST(ObjTest, DropsFacesThatNameNoVertex) {
  EXPECT_EQ(read("a.obj", kSquare + "f 1 2 99\nf 0 1 2\nf -9 1 2\nf 1 1 2\nf 1 2 3\n").triangles,
            (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(ObjTest, GivesVerticesTheFirstTextureCoordinate) {
  const Points points =
      read("a.obj", kSquare + "vt 0.1 0.2\nvt 0.3 0.4\nf 1/1 2/2 3\nf 1/2 3/1 4/1\n");
  ASSERT_EQ(points.texcoords.size(), 4U);
  EXPECT_EQ(points.texcoords[0], glm::vec2(0.1F, 0.2F));
  EXPECT_EQ(points.texcoords[2], glm::vec2(0.1F, 0.2F)) << "its first corner has none";
}

TEST(ObjTest, RepeatsVerticesOfLargeTrianglesForEachNormal) {
  const Points points =
      read("a.obj", kSquare + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4\n");
  ASSERT_EQ(points.normals.size(), 5U);
  EXPECT_EQ(points.triangles, (std::vector<Triangle>{{0, 1, 2}, {4, 2, 3}}));
  EXPECT_EQ(points.positions[4], points.positions[0]);
  EXPECT_EQ(points.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(points.normals[4], glm::vec3(0, 1, 0));
  EXPECT_EQ(points.normals[2], glm::vec3(0, 0, 1));
  EXPECT_EQ(points.normals[3], glm::vec3(0, 0, 0)) << "no corner has one";
}

TEST(ObjTest, GivesVerticesOfSmallTrianglesTheMeanNormal) {
  // A scan of 80 by 80 vertices; one triangle in two has another normal.
  std::string text = "vn 0 0 1\nvn 0 1 0\n";
  for (int k = 0; k < 6400; ++k) text += fmt::format("v {} {} 0\n", k % 80, k / 80);
  for (int k = 0; k < 6320; ++k) {
    if (k % 80 == 79) continue;
    text += fmt::format("f {0}//1 {1}//1 {2}//1\nf {0}//2 {2}//2 {3}//2\n", k + 1, k + 2, k + 82,
                        k + 81);
  }
  const Points points = read("a.obj", text);
  ASSERT_EQ(points.normals.size(), 6400U);
  EXPECT_EQ(points.normals[0], glm::vec3(0, 1, 1));
}

TEST(ObjTest, TrianglesKeepTheSeamsOfTextures) {
  const std::string texcoords = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n";
  EXPECT_TRUE(read("a.obj", kSquare + texcoords + "f 1/1 2/2 3/3 4/4\n").corner_texcoords.empty())
      << "no seam, nothing to keep";
  // A dropped face before the seam must not shift the others; the last face has none for corner 4.
  const Points points =
      read("a.obj", kSquare + texcoords + "f 1/1 1/2 3/3\nf 1/1 2/2 3/3\nf 1/5 3/3 4\n");
  ASSERT_EQ(points.triangles.size(), 2U);
  ASSERT_EQ(points.corner_texcoords.size(), 2U);
  EXPECT_EQ(points.corner_texcoords[0],
            (CornerTexcoords{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1)}));
  EXPECT_EQ(points.corner_texcoords[1],
            (CornerTexcoords{glm::vec2(0.5, 0.5), glm::vec2(1, 1), glm::vec2(0, 0)}));
}

TEST(ObjTest, PointsWithoutFacesHaveTheirNormalsOneByOne) {
  const Points points = read("a.obj", "v 0 0 0\nvn 0 0 1\nv 1 0 0\nvn 0 1 0\n");
  EXPECT_EQ(points.normals, (std::vector{glm::vec3(0, 0, 1), glm::vec3(0, 1, 0)}));
}

TEST(ObjTest, ReadsColoursOfAllVerticesOrOfNone) {
  EXPECT_EQ(read("a.obj", "v 0 0 0 0.2 0 1\nv 1 0 0 1 1 1\n").colours[0], glm::u8vec3(51, 0, 255));
  EXPECT_EQ(read("a.obj", "v 0 0 0 51 0 255\nv 1 0 0 1 1 1\n").colours[0], glm::u8vec3(51, 0, 255));
  EXPECT_TRUE(read("a.obj", "v 0 0 0 0.2 0 1\nv 1 0 0\n").colours.empty());
}

TEST(ObjTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 2\n"),
            "a.obj: line 2: expected three coordinates, and a colour at most, but the line ends; "
            "the file "
            "is truncated or damaged");
  EXPECT_EQ(
      error("a.obj", kSquare + "f 1 2 x\n"),
      "a.obj: line 5: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found 'x'; the file is "
      "truncated or damaged");
  EXPECT_EQ(error("a.obj", "vn 0 0 1\n"), "a.obj: holds no points");
}

TEST(OffTest, ReadsVariantsOfTheHeader) {
  const std::string body = "0 0 0\n1 0 0 # x\n\n0 1 0\n3 0 1 2 255 0 0\n";
  for (const char* head :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "3 1 0\n", "# c\nOFF # c\n# c\n3 1 # c\n"}) {
    const Points points = read("a.off", head + body);
    EXPECT_EQ(points.positions, (std::vector{dvec3(0, 0, 0), dvec3(1, 0, 0), dvec3(0, 1, 0)}))
        << head;
    EXPECT_EQ(points.triangles, (std::vector<Triangle>{{0, 1, 2}})) << head;
  }
}

TEST(OffTest, ReadsTheAttributesThatTheKeywordStates) {
  const Points all =
      read("a.off", "STCNOFF\n1 0 0\n500000.123456789 2 3 0 0.6 0.8 51 0 255 255 0.25 0.75\n");
  EXPECT_EQ(all.positions[0], dvec3(500000.123456789, 2, 3));
  EXPECT_EQ(all.normals, std::vector{glm::vec3(0.F, 0.6F, 0.8F)});
  EXPECT_EQ(all.colours, std::vector{glm::u8vec3(51, 0, 255)});
  EXPECT_EQ(all.texcoords, std::vector{glm::vec2(0.25F, 0.75F)});
  EXPECT_EQ(read("b.off", "COFF\n1 0 0\n1 2 3 0.2 0.0 1.0 1.0\n").colours,
            std::vector{glm::u8vec3(51, 0, 255)});
  EXPECT_EQ(read("c.off", "COFF\n1 0 0\n1 2 3 1 0 1 255\n").colours,
            std::vector{glm::u8vec3(1, 0, 1)})
      << "integers are 0 to 255 however small";
}

TEST(OffTest, FacesHaveColours) {
  const std::string square = "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const Points points =
      read("a.off", square + "3 0 1 3 255 0 0\n4 0 1 2 3 0 0 255 128 # blue\n3 1 2 3 7\n");
  ASSERT_EQ(points.materials.size(), 3U);
  EXPECT_EQ(points.materials[1].colour, glm::vec3(0, 0, 1));
  EXPECT_EQ(points.materials[2].colour, glm::vec3(1)) << "without a colour: white";
  EXPECT_EQ(points.triangle_materials, (std::vector<std::uint32_t>{0, 1, 1, 2}));
  EXPECT_EQ(
      read("a.off", square + "3 0 1 3 0.0 1.0 0.0\n3 1 2 3 a b c\n3 0 1 2\n").materials[0].colour,
      glm::vec3(0, 1, 0));
}

TEST(OffTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      error("a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n"),
      "a.off: line 2: states 2000000000 vertices and 2000000000 faces, but the 9 bytes after it "
      "cannot hold them; the file is truncated or damaged");
  EXPECT_EQ(
      error("a.off", "OFF\n1 1 0\n0 0 0\n2000000000 0 0 0\n"),
      "a.off: line 4: expected the index of a vertex, but the line ends; the file is truncated or "
      "damaged");
  EXPECT_EQ(error("a.off", "4OFF\n1 0 0\n0 0 0 1\n"),
            "a.off: its points are not three-dimensional, so it cannot be read");
  EXPECT_EQ(error("a.off", "OFF BINARY\n1 0 0\n"),
            "a.off: is a binary OFF file, which cannot be read; save it as text");
}

std::string facet(std::string_view corners) {
  return fmt::format("FACET normal 0 0 1\n outer loop\n{} endloop\nendfacet\n", corners);
}

TEST(StlTest, MergesTheCornersOfAsciiFacets) {
  const auto result = try_read(
      "a.stl", "solid s\n" + facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 500000.123456789 0\n") +
                   "endsolid s\nsolid t\n" +
                   facet("vertex 1 0 0\nvertex 1 1e0 0\nvertex 0 500000.123456789 0\n") +
                   "endsolid t\n");
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->points_in_file, 6U);
  EXPECT_EQ(result->merged_duplicates, 2U);
  EXPECT_EQ(result->points.positions[2], dvec3(0, 500000.123456789, 0));
  EXPECT_EQ(result->points.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(StlTest, ABinaryFileMayBeginWithSolid) {
  std::string file = "solid facet";
  file.resize(80, ' ');
  file += pack(std::uint32_t{1}, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F) + "ab";
  for (const char* name : {"a.stl", "a.bin"}) {
    EXPECT_EQ(read(name, file).triangles, (std::vector<Triangle>{{0, 1, 2}})) << name;
  }
}

TEST(StlTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error("a.stl", std::string(80, ' ') + pack(std::uint32_t{2000000000U}) + "abc"),
            "a.stl: states 2000000000 facets, but the 3 bytes after byte 84 cannot hold them; the "
            "file is "
            "truncated or not an STL file");
  EXPECT_EQ(
      error("a.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
      "a.stl: line 4: expected a coordinate, but the line ends; the file is truncated or damaged");
  EXPECT_EQ(
      error("a.stl", "solid s\n" + facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n")),
      "a.stl: line 9: expected endsolid, but the file ends; the file is truncated or damaged");
  EXPECT_EQ(
      error("a.stl", "solid s\n" + facet("vertex 0 0 0\n") + "endsolid\n"),
      "a.stl: line 6: expected a third vertex before, found 'endfacet'; the file is truncated or "
      "damaged");
}

}  // namespace
}  // namespace relief::test

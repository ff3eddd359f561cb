#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;

std::string header(std::string_view format, std::string_view elements) {
  return fmt::format("ply\nformat {} 1.0\n{}end_header\n", format, elements);
}

constexpr std::string_view kXyz = "property float x\nproperty float y\nproperty float z\n";

std::string vertices(int count, std::string_view more = "") {
  return fmt::format("element vertex {}\n{}{}", count, kXyz, more);
}

TEST(PlyTest, ReadsEveryNumberTypeInBothByteOrders) {
  const std::string elements =
      "element vertex 1\nproperty double x\nproperty short y\nproperty uint z\nproperty char a\n"
      "property uint8 b\nproperty ushort c\nproperty int32 d\nproperty float32 nx\nproperty float "
      "ny\n"
      "property float64 nz\n";
  for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
    const std::string body =
        pack(order, 0.1, std::int16_t{-2}, std::uint32_t{4000000000U}, std::int8_t{-1},
             std::uint8_t{255}, std::uint16_t{65535}, -5, 0.25F, 0.5F, 0.75);
    const bool little = order == ByteOrder::Little;
    const Points points = read(
        "a.ply", header(little ? "binary_little_endian" : "binary_big_endian", elements) + body);
    ASSERT_EQ(points.size(), 1U);
    EXPECT_EQ(points.positions[0], dvec3(0.1, -2, 4000000000.0));
    ASSERT_EQ(points.normals.size(), 1U);
    EXPECT_EQ(points.normals[0], glm::vec3(0.25F, 0.5F, 0.75F));
  }
}

TEST(PlyTest, KeepsDoublesAtUtmSize) {
  const std::string elements =
      "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n";
  const dvec3 expected(500000.123456789, 4649776.000000001, 1.5e-7);
  const Points ascii = read("a.ply", header("ascii", elements) +
                                         "500000.123456789 4649776.000000001 1.5e-7\n+1 -2. .5\n");
  const Points binary = read("b.ply", header("binary_little_endian", elements) +
                                          pack(expected.x, expected.y, expected.z, 1.0, -2.0, 0.5));
  EXPECT_EQ(ascii.positions, (std::vector{expected, dvec3(1, -2, 0.5)}));
  EXPECT_EQ(binary.positions, ascii.positions);
}

TEST(PlyTest, SkipsElementsAndPropertiesThatItDoesNotKnow) {
  const std::string elements =
      "comment c\nobj_info num_cols 2\nelement camera 1\nproperty float view_px\nproperty list "
      "uchar "
      "float w\nelement vertex 2\nproperty float quality\nproperty list uchar short tags\n" +
      std::string(kXyz) + "element empty 4000000000\nelement user 1\nproperty int a\n";
  const Points ascii =
      read("a.ply", header("ascii", elements) + "9 2 8 7\n5 0 1 2 3\n\n6 3 1 2 3 4 5 6\n77\n");
  EXPECT_EQ(ascii.positions, (std::vector{dvec3(1, 2, 3), dvec3(4, 5, 6)}));
  const Points binary =
      read("b.ply", header("binary_little_endian", elements) +
                        pack(9.F, std::uint8_t{2}, 8.F, 7.F, 5.F, std::uint8_t{0}, 1.F, 2.F, 3.F) +
                        pack(6.F, std::uint8_t{1}, std::int16_t{1}, 4.F, 5.F, 6.F, 77));
  EXPECT_EQ(binary.positions, ascii.positions);
}

TEST(PlyTest, ReadsFacesBeforeVerticesAndSplitsPolygons) {
  const std::string file = header("ascii",
                                  "element face 3\nproperty list uchar uint vertex_index\n"
                                  "property uchar flags\n" +
                                      vertices(5)) +
                           "4 0 1 2 3 9\n3 4 3 2 9\n2 0 1 9\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 5\n";
  const Points points = read("a.ply", file);
  EXPECT_EQ(points.size(), 5U);
  EXPECT_EQ(points.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 3, 2}}));
}

TEST(PlyTest, TurnsEverySecondTriangleOfAStripAndRestartsAtMinusOne) {
  const std::string body = pack(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 1.F, 1.F, 0.F) +
                           pack(0.F, 2.F, 0.F, 1.F, 2.F, 0.F) +
                           pack(10, 0, 1, 2, 3, 4, -1, -1, 2, 3, 5);
  const Points points = read(
      "a.ply", header("binary_little_endian",
                      vertices(6) + "element tristrips 1\nproperty list int int vertex_indices\n") +
                   body);
  EXPECT_EQ(points.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {2, 3, 5}}));
}

TEST(PlyTest, ARangeGridGivesNoTriangles) {
  const Points points =
      read("a.ply",
           header("ascii",
                  vertices(3) + "element range_grid 4\nproperty list uchar int vertex_indices\n") +
               "0 0 0\n1 0 0\n0 1 0\n1 0\n1 1\n0\n1 2\n");
  EXPECT_EQ(points.size(), 3U);
  EXPECT_TRUE(points.triangles.empty());
}

TEST(PlyTest, ReadsColoursOfEveryScale) {
  struct Case {
    std::string_view type, names, row;
  };
  // 13107 / 65535 = 0.2 = 51 / 255; the scale follows from the file's largest value.
  const Case cases[] = {{"uchar", "red green blue", "51 0 255"},
                        {"ushort", "r g b", "13107 0 65535"},
                        {"float", "diffuse_red diffuse_green diffuse_blue", "0.2 0 1"},
                        {"double", "red green blue", "51 0 255"},
                        {"float", "red green blue", "0.2 nan 1"}};
  for (const Case& c : cases) {
    std::string properties;
    for (std::size_t at = 0; at < c.names.size();
         at = std::min(c.names.find(' ', at), c.names.size() - 1) + 1) {
      properties +=
          fmt::format("property {} {}\n", c.type, c.names.substr(at, c.names.find(' ', at) - at));
    }
    const Points points = read(
        "a.ply", header("ascii", vertices(1, properties)) + "1 2 3 " + std::string(c.row) + "\n");
    ASSERT_EQ(points.colours.size(), 1U) << c.type;
    EXPECT_EQ(points.colours[0], glm::u8vec3(51, 0, 255)) << c.type;
  }
}

TEST(PlyTest, ReadsTextureCoordinatesUnderEachName) {
  for (const auto& [u, v] : {std::pair{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}) {
    const auto more = fmt::format("property float {}\nproperty float {}\n", u, v);
    const Points points = read("a.ply", header("ascii", vertices(1, more)) + "1 2 3 0.25 0.75\n");
    ASSERT_EQ(points.texcoords.size(), 1U) << u;
    EXPECT_EQ(points.texcoords[0], glm::vec2(0.25F, 0.75F));
  }
}

// As MeshLab writes them.
TEST(PlyTest, FacesHaveTextureCoordinatesAndPictures) {
  const std::string faces =
      "element face 3\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nproperty int texnumber\n";
  std::string head = header("ascii", vertices(4) + faces);
  head.insert(head.find("element"),
              "comment TextureFile red paint.png\ncomment texturefile b.png\n");
  const Points points = read("a.ply", head +
                                          "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                          "4 0 1 2 3  8 0 0 0.5 0 0.5 1 0 1  1\n"
                                          "3 0 2 1  6 0.25 0 1 1 1 0  0\n"
                                          "3 1 3 2  0  7\n");
  ASSERT_EQ(points.triangles.size(), 4U);
  ASSERT_EQ(points.materials.size(), 2U);
  EXPECT_EQ(points.materials[0].image, "red paint.png");
  EXPECT_EQ(points.materials[1].image, "b.png");
  EXPECT_EQ(points.triangle_materials, (std::vector<std::uint32_t>{1, 1, 0, kNoMaterial}));
  using Corners = CornerTexcoords;
  EXPECT_EQ(texcoords_of(points, 0), (Corners{{{0, 0}, {0.5, 0}, {0.5, 1}}}));
  EXPECT_EQ(texcoords_of(points, 1), (Corners{{{0, 0}, {0.5, 1}, {0, 1}}}));
  EXPECT_EQ(texcoords_of(points, 2), (Corners{{{0.25, 0}, {1, 1}, {1, 0}}}));
  // A point has the coordinates of its first corner.
  EXPECT_EQ(points.texcoords[0], glm::vec2(0, 0));
  EXPECT_EQ(points.texcoords[2], glm::vec2(0.5, 1));
}

TEST(PlyTest, APictureGoesOnVerticesWithTextureCoordinates) {
  std::string head =
      header("ascii", vertices(3, "property float s\nproperty float t\n") +
                          "element face 1\nproperty list uchar int vertex_indices\n");
  head.insert(head.find("element"), "comment TextureFile a.png\n");
  const Points points = read("a.ply", head + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  ASSERT_EQ(points.materials.size(), 1U);
  EXPECT_TRUE(points.materials[0].is_stated);
  EXPECT_EQ(points.triangle_materials, std::vector<std::uint32_t>{0});
  EXPECT_EQ(texcoords_of(points, 0)[1], glm::vec2(1, 0));
}

TEST(PlyTest, FacesOfFewColoursHaveMaterials) {
  const std::string_view rgb = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto file = [&](std::string_view of_faces, std::string_view faces) {
    return header("ascii", vertices(4) + fmt::format("element face 2\nproperty list uchar int "
                                                     "vertex_indices\n{}",
                                                     of_faces)) +
           corners + std::string(faces);
  };
  const Points points = read("a.ply", file(rgb, "4 0 1 2 3 255 0 0\n3 0 1 3 0 0 51\n"));
  ASSERT_EQ(points.materials.size(), 2U);
  EXPECT_EQ(points.materials[0].colour, glm::vec3(1, 0, 0));
  EXPECT_NEAR(points.materials[1].colour.b, 0.0331F, 1e-4F) << "linear";
  EXPECT_EQ(points.triangle_materials, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_TRUE(points.colours.empty());
  EXPECT_TRUE(
      read("a.ply", file(rgb, "3 0 1 2 255 255 255\n3 0 1 3 255 255 255\n")).materials.empty())
      << "white is no colour";
  const std::string_view reals = "property float red\nproperty float green\nproperty float blue\n";
  EXPECT_EQ(read("a.ply", file(reals, "3 0 1 2 0 1 0\n3 0 1 3 0 0.5 0\n")).materials[0].colour,
            glm::vec3(0, 1, 0));
  // Vertices' own colours come first.
  const Points coloured =
      read("a.ply",
           header("ascii", vertices(3, rgb) + fmt::format("element face 1\nproperty list uchar int "
                                                          "vertex_indices\n{}",
                                                          rgb)) +
               "0 0 0 1 2 3\n1 0 0 4 5 6\n1 1 0 7 8 9\n3 0 1 2 255 0 0\n");
  EXPECT_EQ(coloured.colours[0], glm::u8vec3(1, 2, 3));
  EXPECT_TRUE(coloured.materials.empty());
}

TEST(PlyTest, VerticesOfFacesOfManyColoursHaveTheirMean) {
  // A strip of 400 triangles: the first is black, and each is a little lighter than the one before.
  std::string text = header(
      "ascii", vertices(402) +
                   "element face 400\nproperty list uchar int vertex_indices\nproperty ushort "
                   "red\nproperty ushort green\nproperty ushort blue\n");
  for (int v = 0; v < 402; ++v) text += fmt::format("{} {} 0\n", v / 2, v % 2);
  for (int f = 0; f < 400; ++f)
    text += fmt::format("3 {} {} {} {} {} 0\n", f, f + 1, f + 2, 160 * f, 160 * (f % 7));
  const Points points = read("a.ply", text);
  EXPECT_TRUE(points.materials.empty());
  ASSERT_EQ(points.colours.size(), 402U);
  EXPECT_EQ(points.colours[0].r, 0);
  // Of faces 98, 99 and 100.
  EXPECT_EQ(points.colours[100].r, 160 * 99 * 255 / 65535 + 1) << "rounded up";
}

TEST(PlyTest, HeadersMayEndTheirLinesInAnyWay) {
  // The first byte of the body looks like a line end: 10 is the last byte of 0x0A...
  const float x = std::bit_cast<float>(0x3F80000AU);
  for (const std::string_view end : {"\n", "\r\n", "\r"}) {
    std::string file = header("binary_little_endian", vertices(1));
    for (std::size_t at = file.find('\n'); at != file.npos; at = file.find('\n', at + end.size())) {
      file.replace(at, 1, end);
    }
    const Points points = read("a.ply", file + pack(x, 2.F, 3.F));
    EXPECT_EQ(points.positions, std::vector{dvec3(static_cast<double>(x), 2, 3)});
  }
  const Points text = read("b.ply",
                           "ply\r\nformat ascii 1.0\r\nelement vertex 1\r\nproperty float x\r\n"
                           "property float y\r\nproperty float z\r\nend_header\r\n1 2 3\r\n");
  EXPECT_EQ(text.positions, std::vector{dvec3(1, 2, 3)});
}

TEST(PlyTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      error("a.ply", header("ascii", vertices(2)) + "1 2 3\n4 foo 6\n"),
      "a.ply: line 9: expected a number, found 'foo' (vertex 2 of 2); the file is truncated or "
      "damaged");
  EXPECT_EQ(
      error("a.ply", header("ascii", vertices(2)) + "1 2 3\n4 5\n6 7 8\n"),
      "a.ply: line 9: expected a number, but the line ends (vertex 2 of 2); the file is truncated "
      "or damaged");
  EXPECT_EQ(
      error("a.ply", header("ascii", vertices(1)) + "1 2 3 4\n"),
      "a.ply: line 8: expected the line's end, found '4' (vertex 1 of 1); the file is truncated or "
      "damaged");
  EXPECT_EQ(error("a.ply", header("binary_little_endian", vertices(1000000000)) + "1234"),
            "a.ply: the header states 1000000000 elements 'vertex', but the 4 bytes after byte 124 "
            "cannot "
            "hold them; the file is truncated or damaged");
  EXPECT_EQ(error("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
            "a.ply: line 3: expected the number of elements, found '-1'; the header is damaged");
  EXPECT_EQ(
      error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float128 x\n"),
      "a.ply: line 4: expected the type and name of a property, found 'float128'; the header is "
      "damaged");
  EXPECT_EQ(error("a.ply", header("ascii", "element vertex 1\nproperty float x\n") + "1\n"),
            "a.ply: its vertices have no properties x, y and z");
  EXPECT_EQ(
      error("a.ply", header("ascii", "element face 0\nproperty list uchar int vertex_index\n")),
      "a.ply: the header has 0 elements 'vertex', but one is needed");
  EXPECT_EQ(error("a.ply", header("ascii", vertices(0))), "a.ply: holds no points");
}

TEST(PlyTest, AListLongerThanTheFileIsRefused) {
  const std::string elements =
      vertices(1) + "element face 1\nproperty list int int vertex_indices\n";
  const std::string start = header("binary_little_endian", elements) + pack(1.F, 2.F, 3.F);
  EXPECT_NE(error("a.ply", start + pack(2000000000, 1, 2, 3)).find("longer than the file"),
            std::string::npos);
  EXPECT_NE(error("a.ply", start + pack(-3, 1, 2, 3)).find("less than 0"), std::string::npos);
}

}  // namespace
}  // namespace relief::test

#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;

TEST(XyzTest, ReadsEverySeparatorAndKeepsDoubles) {
  const std::vector<dvec3> expected = {{500000.123456789, 4649776.000000001, -0.1}, {1, 2, 3}};
  for (const char* separator : {" ", "\t", ",", ";", ", ", "  "}) {
    const std::string text =
        fmt::format("500000.123456789{0}4649776.000000001{0}-0.1\r\n1{0}2{0}3\r\n", separator);
    EXPECT_EQ(read("a.xyz", text).positions, expected) << '\'' << separator << '\'';
  }
}

TEST(XyzTest, EachEndingOfTheNameIsKnown) {
  for (const char* name : {"a.xyz", "a.txt", "a.CSV", "a.asc", "a.pts", "a.xyzrgb", "a.xyzn"}) {
    EXPECT_EQ(read(name, "1 2 3\n4 5 6\n").size(), 2U) << name;
  }
}

TEST(XyzTest, PassesOverHeadersCommentsAndEmptyLines) {
  const char* const text =
      "\xEF\xBB\xBFSome scanner, 2003\n# made here\n\n//X Y Z\n1 2 3\n\n# between\n4 5 6\n% end\n";
  EXPECT_EQ(read("a.txt", text).positions, (std::vector{dvec3(1, 2, 3), dvec3(4, 5, 6)}));
}

struct ColumnCase {
  const char* what;
  const char* name;
  const char* text;
  bool normals;
  bool colours;
};

TEST(XyzTest, FindsColoursAndNormalsAmongTheColumns) {
  const ColumnCase cases[] = {
      {"r g b", "a.xyz", "1 2 3 51 0 255\n4 5 6 0 0 0\n", false, true},
      {"16-bit r g b", "a.xyz", "1 2 3 13107 0 65535\n4 5 6 0 0 0\n", false, true},
      {"r g b from 0 to 1", "a.xyz", "1 2 3 0.2 0 1\n4 5 6 0 0 0.5\n", false, true},
      {"nx ny nz", "a.xyz", "1 2 3 0 0.6 0.8\n4 5 6 -1 0 0\n", true, false},
      {"whole numbers that are normals", "a.xyz", "1 2 3 0 0 1\n4 5 6 1 0 0\n", true, false},
      {"nx ny nz r g b", "a.xyz", "1 2 3 0 0.6 0.8 51 0 255\n4 5 6 -1 0 0 0 0 0\n", true, true},
      {"r g b nx ny nz", "a.xyz", "1 2 3 51 0 255 0 0.6 0.8\n4 5 6 0 0 0 -1 0 0\n", true, true},
      {"intensity", "a.xyz", "1 2 3 0.7\n4 5 6 0.2\n", false, false},
      {"intensity below 0, r g b", "a.pts", "2\n1 2 3 -1024 51 0 255\n4 5 6 -7 0 0 0\n", false,
       true},
      {"intensity like a colour, r g b", "a.pts", "1 2 3 9 51 0 255\n4 5 6 8 0 0 0\n", false, true},
      {"no unit vectors", "a.xyz", "1 2 3 -7 0.6 0.8\n4 5 6 -1 3 0\n", false, false},
      {"normals by the name", "a.xyzn", "1 2 3 0 3 4\n4 5 6 -9 0 0\n", true, false},
      {"colours by the name", "a.xyzrgb", "1 2 3 0.2 0 1\n4 5 6 1 0 0\n", false, true},
      {"named columns", "a.csv", "\"Y\",\"X\",\"Z\",\"Nx\",\"Ny\",\"Nz\"\n2,1,3,51,0,255\n", true,
       false},
      {"named by CloudCompare", "a.asc", "//X Y Z R G B Scalar_field\n1 2 3 51 0 255 0.5\n", false,
       true},
  };
  for (const ColumnCase& c : cases) {
    const Points points = read(c.name, c.text);
    ASSERT_FALSE(points.positions.empty()) << c.what;
    EXPECT_EQ(points.positions[0], dvec3(1, 2, 3)) << c.what;
    EXPECT_EQ(!points.normals.empty(), c.normals) << c.what;
    ASSERT_EQ(!points.colours.empty(), c.colours) << c.what;
    if (c.colours) {
      EXPECT_EQ(points.colours[0], glm::u8vec3(51, 0, 255)) << c.what;
    }
  }
  EXPECT_EQ(read("a.xyz", "1 2 3 51 0 255 0 0.6 0.8\n4 5 6 0 0 0 -1 0 0\n").normals[0],
            glm::vec3(0.F, 0.6F, 0.8F));
}

TEST(XyzTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error("a.xyz", "1 2 3\n4 5\n"),
            "a.xyz: line 2: expected 3 numbers, found 2; the file is truncated or damaged");
  EXPECT_EQ(error("a.xyz", "1 2\n"),
            "a.xyz: line 1: expected 3 or more numbers, found 2; the file is truncated or damaged");
  EXPECT_EQ(
      error("a.xyz", "1 2 3\n4 foo 6\n"),
      "a.xyz: line 2: expected a number, found 'foo'; the file is damaged or not a list of points");
  EXPECT_EQ(error("a.pts", "3\n1 2 3\n4 5 6\n"),
            "a.pts: states 3 points, but has 2; the file is truncated");
  EXPECT_EQ(error("a.csv", "1,5;2,5;3,5\n"),
            "a.csv: line 1: the numbers have decimal commas; write them with points");
  EXPECT_EQ(error("a.asc", "ncols 3\nnrows 1\n1 2 3\n"),
            "a.asc: is a grid of heights (ESRI ASCII), not a list of points");
  std::string grid;
  for (int i = 0; i < 100; ++i) grid += "1,";
  EXPECT_EQ(error("a.csv", grid + "1\n"),
            "a.csv: line 1: has more than 24 columns, so it is not a list of points");
  std::string prose;
  for (int i = 0; i < 200; ++i) prose += "words\n";
  EXPECT_EQ(error("a.txt", prose),
            "a.txt: the first 100 lines have no numbers, so it is not a list of points");
}

}  // namespace
}  // namespace relief::test

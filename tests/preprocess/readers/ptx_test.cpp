#include <fmt/format.h>

#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;
using glm::u8vec3;

/// The header of a scan whose frame is turned by a quarter about z (x to y) and moved.
std::string header(int columns, int rows, std::string_view position = "500000.25 4649776.125 10") {
  return fmt::format("{}\n{}\n{}\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n{} 1\n",
                     columns, rows, position, position);
}

TEST(PtxTest, PutsPointsIntoTheWorldAndDropsBeamsThatDidNotComeBack) {
  const auto result =
      try_read("a.ptx", header(2, 2) + "1 2 3 0.5\n0 0 0 0.5\r\n0.001 0 0 0.25\n-4 -5 -6 1\n");
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->points_in_file, 4U);
  EXPECT_EQ(result->dropped_nonfinite, 1U);
  EXPECT_EQ(result->points.positions, (std::vector<dvec3>{{500000.25 - 2, 4649776.125 + 1, 13},
                                                          {500000.25, 4649776.125 + 0.001, 10},
                                                          {500000.25 + 5, 4649776.125 - 4, 4}}));
  EXPECT_TRUE(result->points.colours.empty());
  EXPECT_EQ(result->points.viewpoint, std::optional(dvec3(500000.25, 4649776.125, 10)));
}

TEST(PtxTest, ReadsSeveralScansWithColours) {
  const std::string one = header(1, 2, "1 0 0") + "1 0 0 0.5 255 128 0\n0 0 0 0.5 0 0 0\n";
  const std::string two = header(2, 1, "0 0 5") + "1 0 0 0.5 1 2 3\n2 0 0 0.5 4 5 6\n";
  const Points points = read("a.ptx", one + two);
  EXPECT_EQ(points.positions, (std::vector<dvec3>{{1, 1, 0}, {0, 1, 5}, {0, 2, 5}}));
  EXPECT_EQ(points.colours, (std::vector<u8vec3>{{255, 128, 0}, {1, 2, 3}, {4, 5, 6}}));
  EXPECT_FALSE(points.viewpoint.has_value());
  EXPECT_EQ(points.scanners, (std::vector<dvec3>{{1, 0, 0}, {0, 0, 5}}));
  EXPECT_EQ(points.scanner_of, (std::vector<std::uint16_t>{0, 1, 1}));
  const auto mixed = try_read("a.ptx", one + header(1, 1) + "1 0 0 0.5\n");
  ASSERT_TRUE(mixed);
  EXPECT_TRUE(mixed->points.colours.empty());
  EXPECT_EQ(mixed->notes,
            std::vector<std::string>{"a.ptx: only 1 of 2 scans have colours; they are left out"});
}

TEST(PtxTest, SaysWhatIsWrongAndWhere) {
  const std::string one = header(1, 2) + "1 2 3 0.5 9 9 9\n1 2 4 0.5 9 9 9\n";
  ASSERT_EQ(read("a.ptx", one).size(), 2U);
  const auto with = [&one](std::string_view what, std::string_view by) {
    std::string text = one;
    return text.replace(text.rfind(what), what.size(), by);
  };
  const std::string end = "; the file is truncated or damaged";
  EXPECT_EQ(error("a.ptx", "1\n4000000000\n0 0 0\n"),
            "a.ptx: line 2: states 1 columns and 4000000000 rows, but the 7 bytes that are left "
            "cannot hold as many points" +
                end);
  EXPECT_EQ(
      error("a.ptx", "4611686018427387904\n4\n0 0 0\n"),
      "a.ptx: line 2: states 4611686018427387904 columns and 4 rows, but the 7 bytes that are "
      "left cannot hold as many points" +
          end);
  EXPECT_EQ(error("a.ptx", "x\n"), "a.ptx: line 1: expected a number of columns, found 'x'" + end);
  EXPECT_EQ(error("a.ptx", with("1 2 4 0.5 9 9 9", "1 2 4 0.5")),
            "a.ptx: line 12: expected red, green and blue, but the line ends" + end);
  EXPECT_EQ(error("a.ptx", with("9 9 9\n", "9 9 9 9\n")),
            "a.ptx: line 12: expected the line's end, found '9'" + end);
  EXPECT_EQ(error("a.ptx", with("0 0 1 0\n", "0 0 1\n")),
            "a.ptx: line 9: expected four numbers of the scan's matrix, but the line ends" + end);
}

}  // namespace
}  // namespace relief::test

#include "preprocess/readers/pcd/lzf.h"
#include "preprocess/readers/pcd/sensor_stance.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;

constexpr float kPcdNan = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<std::string_view, 4> kRgbFloat = {" rgb", " 4", " F", " 1"};

TEST(PcdTest, ReadsTheSamePointsInEachEncoding) {
  const std::vector<dvec3> expected = {{1, 2, 3}, {4, 5, 6}};
  const std::string rows = pack(1.F, 2.F, 3.F, 4.F, 5.F, 6.F);
  const std::string packed = lzf_literals(pack(1.F, 4.F, 2.F, 5.F, 3.F, 6.F));
  EXPECT_EQ(read("a.pcd", pcd_header(2, "ascii") + "1 2 3\n4 5 6\n").positions, expected);
  EXPECT_EQ(read("b.pcd", pcd_header(2, "binary") + rows).positions, expected);
  EXPECT_EQ(
      read("c.pcd", pcd_header(2, "binary_compressed") +
                        pack(static_cast<std::uint32_t>(packed.size()), std::uint32_t{24}) + packed)
          .positions,
      expected);
}

TEST(PcdTest, KeepsDoublesAtUtmSize) {
  const dvec3 expected(500000.123456789, 4649776.000000001, -0.1);
  EXPECT_EQ(read("a.pcd", pcd_header(1, "ascii", 8) + "500000.123456789 4649776.000000001 -0.1\n")
                .positions[0],
            expected);
  EXPECT_EQ(read("b.pcd", pcd_header(1, "binary", 8) + pack(expected.x, expected.y, expected.z))
                .positions[0],
            expected);
}

TEST(PcdTest, UnpacksColours) {
  const glm::u8vec3 expected(200, 100, 50);
  const std::uint32_t opaque = 0xFFC86432U;
  const std::uint32_t clear = 0x00C86432U;
  const std::array<std::string_view, 4> integer = {" rgba", " 4", " U", " 1"};
  const auto is_expected = [&](const Points& points, const char* what) {
    ASSERT_EQ(points.colours.size(), 1U) << what;
    EXPECT_EQ(points.colours[0], expected) << what;
  };
  const std::string xyz = pack(1.F, 2.F, 3.F);
  // The opaque colour's bits are a NaN: it must not be taken for a number on the way.
  is_expected(read("a.pcd", pcd_header(1, "binary", 4, kRgbFloat) + xyz + pack(opaque)), "float");
  is_expected(read("b.pcd", pcd_header(1, "binary", 4, integer) + xyz + pack(opaque)), "integer");
  is_expected(read("c.pcd", pcd_header(1, "ascii", 4, integer) + "1 2 3 4291322930\n"), "text");
  is_expected(read("d.pcd", pcd_header(1, "ascii", 4, kRgbFloat) + "1 2 3 4291322930\n"),
              "an integer where a float is stated, as PCL writes it");
  is_expected(read("e.pcd", pcd_header(1, "ascii", 4, kRgbFloat) +
                                fmt::format("1 2 3 {:.9g}\n", std::bit_cast<float>(clear))),
              "the float that has the bits, as text");
  is_expected(read("f.pcd", pcd_header(1, "binary", 4, {" r g b", " 1 1 1", " U U U", " 1 1 1"}) +
                                xyz + "\xC8\x64\x32"),
              "three fields");
}

TEST(PcdTest, ReadsNormalsAndStepsOverFieldsOfManyNumbers) {
  const std::array<std::string_view, 4> more = {" h normal_x normal_y normal_z", " 2 4 4 4",
                                                " U F F F", " 3 1 1 1"};
  const std::uint16_t h = 7;
  const Points binary = read("a.pcd", pcd_header(1, "binary", 4, more) +
                                          pack(1.F, 2.F, 3.F, h, h, h) + pack(0.F, 0.6F, 0.8F));
  const Points ascii = read("b.pcd", pcd_header(1, "ascii", 4, more) + "1 2 3 7 7 7 0 0.6 0.8\n");
  EXPECT_EQ(binary.normals, std::vector{glm::vec3(0.F, 0.6F, 0.8F)});
  EXPECT_EQ(ascii.normals, binary.normals);
}

TEST(PcdTest, DropsAndCountsTheInvalidPointsOfAnOrganisedCloud) {
  std::string file = pcd_header(4, "binary");
  file.replace(file.find("WIDTH 4\nHEIGHT 1"), 16, "WIDTH 2\nHEIGHT 2");
  file += pack(kPcdNan, kPcdNan, kPcdNan, 1.F, 2.F, 3.F, 4.F,
               std::numeric_limits<float>::infinity(), 6.F, 7.F, 8.F, 9.F);
  const auto result = try_read("a.pcd", file);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->points_in_file, 4U);
  EXPECT_EQ(result->dropped_nonfinite, 2U);
  EXPECT_EQ(result->points.positions, (std::vector{dvec3(1, 2, 3), dvec3(7, 8, 9)}));
  EXPECT_EQ(read("b.pcd", pcd_header(2, "ascii") + "nan nan -nan\n1 2 3\n").size(), 1U);
}

TEST(PcdTest, OnlyAViewpointThatIsNotTheDefaultIsOne) {
  const std::string file = pcd_header(1, "ascii") + "1 2 3\n";
  EXPECT_FALSE(read("a.pcd", file).viewpoint.has_value());
  std::string moved = file;
  moved.replace(moved.find("0 0 0 1 0 0 0"), 13, "5 6 7 1 0 0 0");
  EXPECT_EQ(read("b.pcd", moved).viewpoint, std::optional(dvec3(5, 6, 7)));
}

TEST(PcdTest, TheDefaultIsTheViewpointOfACamerasRowsAndColumns) {
  std::string file = pcd_header(2, "ascii") + "1 2 3\n4 5 6\n";
  const auto replace = [&file](const std::string& what, const std::string& with) {
    ASSERT_NE(file.find(what), std::string::npos) << file;
    file.replace(file.find(what), what.size(), with);
  };
  replace("WIDTH 2", "WIDTH 1");
  replace("HEIGHT 1", "HEIGHT 2");
  EXPECT_EQ(read("c.pcd", file).viewpoint, std::optional(dvec3(0, 0, 0)));
}

TEST(PcdTest, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(
      error("a.pcd", pcd_header(4000000000U, "binary") + pack(1.F, 2.F, 3.F)),
      "a.pcd: the header states 4000000000 points, but the 12 bytes after byte 182 cannot hold "
      "them; the file is truncated or damaged");
  EXPECT_EQ(error("a.pcd", pcd_header(2, "ascii") + "1 2 3\n4 5 x\n"),
            "a.pcd: line 13: expected a number, found 'x' (point 2 of 2); the file is truncated or "
            "damaged");
  EXPECT_EQ(error("a.pcd", pcd_header(1, "binary", 3) + std::string(9, '\0')),
            "a.pcd: field 'x' has type 'F', size 3 and count 1, which no PCD file can have; the "
            "header is "
            "damaged");
  EXPECT_EQ(
      error("a.pcd", "# .PCD v0.7\nFIELDS x y\nSIZE 4\nDATA ascii\n"),
      "a.pcd: FIELDS, SIZE, TYPE and COUNT have 2, 1, 2 and 2 entries, but they must have equally "
      "many; the header is damaged");
  std::string mismatch = pcd_header(2, "ascii") + "1 2 3\n4 5 6\n";
  mismatch.replace(mismatch.find("WIDTH 2"), 7, "WIDTH 3");
  EXPECT_EQ(error("a.pcd", mismatch),
            "a.pcd: the header states 2 points, but a width of 3 and a height of 1; it is damaged");
}

TEST(SensorStance, IsThatOfASensorIfThePointsAreBeforeIt) {
  std::vector<glm::dvec3> ahead;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) ahead.emplace_back(0.1 * i, 0.1 * j, 2.0);
  }
  const Stance stance = sensor_stance(ahead, {});
  EXPECT_EQ(stance, (Stance{{0, -1, 0}, {0, 0, -1}, true}));
  // Drivers give a pose that turns points upright which lie in the sensor's own frame.
  EXPECT_EQ(sensor_stance(ahead, {{}, glm::dquat(0.0, 1.0, 0.0, 0.0)}), stance);
  // A sensor that looks along X, with Z up: its axes are -Y, -Z and X.
  SensorPose level{{5.0, 0.0, 1.0}, glm::dquat(0.5, -0.5, 0.5, -0.5)};
  std::vector<glm::dvec3> world = ahead;
  for (glm::dvec3& p : world) p = level.position + level.turn * p;
  const Stance turned = sensor_stance(world, level);
  EXPECT_LT(glm::distance(turned.up, glm::dvec3(0, 0, 1)), 1e-12);
  EXPECT_LT(glm::distance(turned.front, glm::dvec3(-1, 0, 0)), 1e-12);
  EXPECT_TRUE(turned.is_from_sensor);
  // Beside the line of sight: a map in the frame of its first image.
  std::vector<glm::dvec3> beside = ahead;
  for (glm::dvec3& p : beside) p.x += 2.0;
  EXPECT_FALSE(sensor_stance(beside, {}).is_from_sensor);
  EXPECT_EQ(sensor_stance(beside, {}).up, glm::dvec3(0, -1, 0));
}

TEST(SensorStance, IsZUpOfAMap) {
  std::vector<glm::dvec3> map;
  for (int i = -10; i <= 10; ++i) {
    for (int j = -10; j <= 10; ++j) map.emplace_back(i, j, 0.05 * i);
  }
  EXPECT_EQ(sensor_stance(map, {}), kZUp);
  EXPECT_EQ(sensor_stance({}, {}), kZUp);
}

TEST(LzfTest, ExpandsBackReferencesAndRefusesWhatLeadsAstray) {
  const auto expand = [](std::string_view packed, std::size_t size) {
    std::vector<char> out(size, '?');
    return lzf_decompress(packed, out) ? std::string(out.begin(), out.end()) : "refused";
  };
  // Two literals, then 3 bytes from 2 back; then 7 + 2 + 1 bytes from 1 back.
  EXPECT_EQ(expand({"\x01"
                    "ab"
                    "\x20\x01",
                    5},
                   5),
            "ababa");
  EXPECT_EQ(expand({"\x00"
                    "a"
                    "\xE0\x01\x00",
                    5},
                   11),
            "aaaaaaaaaaa");
  EXPECT_EQ(expand({"\x00"
                    "a"
                    "\x20\x01",
                    4},
                   4),
            "refused")
      << "before the start";
  EXPECT_EQ(expand({"\x05"
                    "ab",
                    3},
                   6),
            "refused")
      << "literals beyond the end";
  EXPECT_EQ(expand({"\x01"
                    "ab",
                    3},
                   1),
            "refused")
      << "more than asked for";
  EXPECT_EQ(expand({"\x01"
                    "ab",
                    3},
                   3),
            "refused")
      << "less than asked for";
  EXPECT_EQ(expand({"\x00"
                    "a"
                    "\xE0",
                    3},
                   11),
            "refused")
      << "cut off";
}

}  // namespace
}  // namespace relief::test

// Scalars of each format: names, values, and what is said of those that are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scalar.h"
#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief {
namespace {

Result<ReadResult> try_read(const std::string& name, std::string_view bytes,
                            const ScalarChoice& choice) {
  Progress progress;
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  return read_bytes(name, {begin, begin + bytes.size()}, progress, {.scalars = choice});
}

std::vector<PointScalar> read(const std::string& name, std::string_view bytes,
                              const ScalarChoice& choice = {true, {}}) {
  auto result = try_read(name, bytes, choice);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  for (const PointScalar& scalar : result->points.scalars)
    EXPECT_EQ(scalar.values.size(), result->points.size()) << scalar.name;
  return std::move(result->points.scalars);
}

const PointScalar& named(const std::vector<PointScalar>& scalars, const std::string& name) {
  static const PointScalar none;
  const auto found = std::ranges::find(scalars, name, &PointScalar::name);
  if (found != scalars.end()) return *found;
  ADD_FAILURE() << "there is no " << name;
  return none;
}

using test::described;
using Values = std::vector<double>;

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nproperty float quality\nproperty list uchar int ring\nproperty int Segment_Index\n"
    "property float scalar_Intensity\nproperty float height\nend_header\n"
    "0 0 0 0.5 1 9 3 17 100\n1 0 0 nan 0 4 18 200\n0 1 0 0.75 2 9 9 5 19 300\n";

TEST(ScalarsOfPly, AreAllOtherPropertiesOfAVertex) {
  const auto scalars = read("a.ply", kPly);
  ASSERT_EQ(scalars.size(), 4U);
  EXPECT_EQ(named(scalars, "quality").values[0], 0.5);
  EXPECT_TRUE(std::isnan(named(scalars, "quality").values[1]));
  EXPECT_FALSE(named(scalars, "quality").is_label);
  EXPECT_EQ(named(scalars, "segment_index").values, (Values{3, 4, 5}));
  EXPECT_TRUE(named(scalars, "segment_index").is_label);
  EXPECT_EQ(named(scalars, "intensity").values, (Values{17, 18, 19}));
  EXPECT_EQ(named(scalars, "file_height").values, (Values{100, 200, 300}));
}

TEST(Scalars, AreOnlyReadIfAskedFor) {
  EXPECT_TRUE(read("a.ply", kPly, {}).empty());
  const auto one = read("a.ply", kPly, {false, {"quality"}});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].name, "quality");
}

TEST(Scalars, ThatAreMissingAreNamedWithThoseThatAreThere) {
  const auto missing = try_read("a.ply", kPly, {false, {"confidence"}});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message,
            "a.ply: has no scalar 'confidence'; it has quality, segment_index, intensity, "
            "file_height");
  const auto none = try_read("a.xyz", "0 0 0\n1 0 0\n0 1 0\n", {false, {"confidence"}});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "a.xyz: has no scalar 'confidence'; it has none");
  const auto empty = try_read("a.xyz", "0 0 0 nan\n1 0 0 nan\n", {false, {"column4"}});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().message, "a.xyz: its scalar 'column4' has no finite number");
  EXPECT_TRUE(read("a.xyz", "0 0 0 nan\n1 0 0 inf\n").empty());
}

TEST(Scalars, OfManyPropertiesAreKeptUpToTheLimit) {
  std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\n";
  std::string row;
  for (const char* name : {"x", "y", "z"}) ply += fmt::format("property float {}\n", name);
  for (int k = 0; k < 60; ++k) {
    ply += fmt::format("property float f_rest_{}\n", k);
    row += fmt::format(" {}", k + 0.5);
  }
  ply += "end_header\n0 0 0" + row + "\n";
  EXPECT_EQ(read("a.ply", ply).size(), kMaxScalars);
  EXPECT_EQ(read("a.ply", ply, {false, {"f_rest_59"}})[0].values, (Values{59.5}));
  const auto missing = try_read("a.ply", ply, {false, {"no"}});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("and 48 more"), std::string::npos);
}

TEST(Scalars, OfMergedPointsAreThoseOfTheFirst) {
  const auto scalars = read("a.xyz", "0 0 0 1.5\n1 0 0 2.5\n0 0 0 3.5\n0 1 0 4.5\nnan 0 0 5.5\n");
  ASSERT_EQ(scalars.size(), 1U);
  EXPECT_EQ(scalars[0].values, (Values{1.5, 2.5, 4.5}));
}

TEST(ScalarsOfText, HaveTheNamesOfTheirColumns) {
  const auto named_columns = read("a.csv", "x,y,z,Class,dev\n0,0,0,2,0.5\n1,0,0,6,0.25\n");
  EXPECT_EQ(named(named_columns, "classification").values, (Values{2, 6}));
  EXPECT_TRUE(named(named_columns, "classification").is_label);
  EXPECT_EQ(named(named_columns, "dev").values, (Values{0.5, 0.25}));
  EXPECT_EQ(named(read("a.pts", "2\n0 0 0 -900\n1 0 0 77\n"), "intensity").values,
            (Values{-900, 77}));
  EXPECT_EQ(named(read("a.xyz", "0 0 0 8.5\n1 0 0 9\n"), "column4").values, (Values{8.5, 9}));
}

TEST(ScalarsOfPcd, AreFieldsOfOneNumber) {
  const std::string header =
      test::pcd_header(2, "ascii", 4, {" curvature histogram _", " 4 4 1", " F F U", " 1 3 1"});
  const auto scalars = read("a.pcd", header + "0 0 0 0.5 1 2 3 0\n1 0 0 0.25 4 5 6 0\n");
  ASSERT_EQ(scalars.size(), 1U);
  EXPECT_EQ(named(scalars, "curvature").values, (Values{0.5, 0.25}));
  const std::string binary = test::pcd_header(2, "binary", 4, {" label", " 2", " U", " 1"});
  const auto labels = read("b.pcd", binary + test::pack(0.F, 0.F, 0.F, std::uint16_t{7}, 1.F, 0.F,
                                                        0.F, std::uint16_t{65534}));
  EXPECT_EQ(named(labels, "label").values, (Values{7, 65534}));
  EXPECT_TRUE(named(labels, "label").is_label);
}

TEST(ScalarsOfPtx, AreTheIntensity) {
  const std::string ptx =
      "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
      "0 0 0 0.1\n1 0 0 0.75\n";
  // The first is a beam without an echo.
  EXPECT_EQ(named(read("a.ptx", ptx), "intensity").values, (Values{0.75}));
}

TEST(ScalarsOfLas, AreThoseOfEachPointRecordFormat) {
  for (std::uint8_t format = 0; format <= 10; ++format) {
    SCOPED_TRACE(int{format});
    const bool wide = format >= 6;
    const auto scalars = read(
        "a.las",
        test::las_file(
            {.minor = static_cast<std::uint8_t>(wide ? 4 : 3),
             .format = format,
             .extra_bytes = 2,
             .points = {
                 {.steps = {0, 0, 0}, .point_class = 2, .return_number = 1, .returns = 3},
                 {.steps = {100, 0, 0}, .point_class = 6, .return_number = 2, .returns = 5}}}));
    EXPECT_EQ(named(scalars, "intensity").values, Values(2, 0xABCD));
    EXPECT_EQ(named(scalars, "return_number").values, (Values{1, 2}));
    EXPECT_EQ(named(scalars, "number_of_returns").values, (Values{3, 5}));
    EXPECT_EQ(named(scalars, "classification").values, (Values{2, 6}));
    EXPECT_TRUE(named(scalars, "classification").is_label);
    EXPECT_DOUBLE_EQ(named(scalars, "scan_angle").values[0], wide ? -5.4 : -9.0);
    EXPECT_EQ(named(scalars, "user_data").values, Values(2, 0xEE));
    EXPECT_EQ(named(scalars, "point_source_id").values, Values(2, 7));
    if (wide || format == 1 || (format >= 3 && format <= 5))
      EXPECT_EQ(named(scalars, "gps_time").values, Values(2, 123456.789));
    else
      EXPECT_EQ(scalars.size(), 7U);
  }
}

/// Two points with extra bytes, and their record.
std::string with_record(const std::string& record, std::uint16_t extra_bytes) {
  return test::las_file_with_record(
      {.format = 0, .extra_bytes = extra_bytes, .points = {{}, {{100, 0, 0}}}}, record);
}

TEST(ExtraBytesOfLas, AreReadAsTheirRecordDescribesThem) {
  // A point's extra bytes are all 0x3C.
  const std::string record = described("Deviation", 3, 0x08, 0.5) +  // u16, scaled
                             described("pair", 11) +                 // u8, u8: no single number
                             described("Amplitude", 1, 0x10, 0, 100.0) +
                             described("flag", 1, 0x01, 0, 0, 0x3C);  // all without data
  const auto scalars = read("a.las", with_record(record, 6));
  EXPECT_EQ(named(scalars, "deviation").values, Values(2, 0.5 * 0x3C3C));
  EXPECT_EQ(named(scalars, "amplitude").values, Values(2, 160.0));
  EXPECT_EQ(std::ranges::count(scalars, "pair", &PointScalar::name), 0);
  EXPECT_EQ(std::ranges::count(scalars, "flag", &PointScalar::name), 0);
}

TEST(ExtraBytesOfLas, ThatDoNotFitThePointsAreIgnored) {
  // The second number would lie beyond the record; the third follows it.
  const std::string record = described("one", 1) + described("eight", 10) + described("more", 1);
  const auto scalars = read("a.las", with_record(record, 4));
  EXPECT_EQ(named(scalars, "one").values, Values(2, 0x3C));
  EXPECT_EQ(std::ranges::count(scalars, "eight", &PointScalar::name), 0);
  EXPECT_EQ(std::ranges::count(scalars, "more", &PointScalar::name), 0);
  EXPECT_EQ(read("a.las", with_record(described("cut", 1).substr(0, 191), 4)).size(), 7U);
  EXPECT_EQ(read("a.las", with_record(described("unknown", 31) + described("b", 1), 4)).size(), 7U);
}

}  // namespace
}  // namespace relief

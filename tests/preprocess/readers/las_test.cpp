#include <cmath>

#include "preprocess/readers/las/las_point.h"
#include "tests/preprocess/readers/las_files.h"
#include "tests/preprocess/readers/scan_files.h"

namespace relief::test {
namespace {

using glm::dvec3;
using glm::u8vec3;

/// The version that brought a point record format.
std::uint8_t version_of(int format) {
  return format < 4 ? 2 : (format < 6 ? 3 : 4);
}

std::string with_bytes(std::string file, std::size_t at, std::string_view bytes) {
  return file.replace(at, bytes.size(), bytes);
}

TEST(LasTest, ReadsEachPointRecordFormat) {
  constexpr std::size_t sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  for (int format = 0; format <= 10; ++format) {
    for (const std::uint16_t extra : {0, 5}) {
      LasFile file{.minor = version_of(format),
                   .format = static_cast<std::uint8_t>(format),
                   .extra_bytes = extra,
                   .records = 1,
                   .offset = {10, 20, -30}};
      file.points = {{{100, -200, 300}, 2, false, {0xFFFF, 0x80FF, 0x0100}},
                     {{-1, 2147483647, INT32_MIN}, 2, false, {0, 0, 0xFE00}}};
      ASSERT_EQ(las_record({}, file.format, 0).size(), sizes[format]);
      const auto too_short = static_cast<std::uint16_t>(sizes[format] - 1);
      EXPECT_NE(error("a.las", with_bytes(las_file(file), 105, pack(too_short)))
                    .find(fmt::format("have at least {}", sizes[format])),
                std::string::npos);
      const Points points = read("a.las", las_file(file));
      // The very numbers that the format defines: offset + scale * integer, in double.
      EXPECT_EQ(points.positions,
                (std::vector<dvec3>{
                    {10 + 0.01 * 100, 20 + 0.01 * -200, -30 + 0.01 * 300},
                    {10 + 0.01 * -1, 20 + 0.01 * 2147483647.0, -30 + 0.01 * -2147483648.0}}))
          << format;
      const bool coloured =
          format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      EXPECT_EQ(points.colours, coloured ? (std::vector<u8vec3>{{255, 128, 1}, {0, 0, 254}})
                                         : std::vector<u8vec3>())
          << format;
    }
  }
}

TEST(LasTest, ReadsEachVersion) {
  for (const std::uint8_t minor : {1, 2, 3, 4}) {
    for (const std::uint8_t format : {0, 3}) {
      const Points points =
          read("a.las", las_file({.minor = minor, .format = format, .points = {{{1, 2, 3}}}}));
      EXPECT_EQ(points.size(), 1U) << int{minor};
    }
  }
}

TEST(LasTest, KeepsAQuarterOfAMillimetreAtUtmSize) {
  LasFile file{.minor = 4,
               .format = 6,
               .scale = {0.00025, 0.00025, 0.00025},
               .offset = {515384.823, 4918360.741, 2330.73575}};
  for (std::int32_t i = 0; i < 1000; ++i) file.points.push_back({{i, 100000 - i, 37 * i}});
  const Points points = read("a.las", las_file(file));
  ASSERT_EQ(points.size(), 1000U);  // float would merge hundreds of them
  for (std::int32_t i = 0; i < 1000; ++i) {
    // From metres back to the file's integers. A double at 5e6 m has steps of 1e-9 m, 4e-6 of a
    // step of the file.
    const dvec3 steps = (points.positions[static_cast<std::size_t>(i)] -
                         dvec3(515384.823, 4918360.741, 2330.73575)) /
                        0.00025;
    EXPECT_NEAR(steps.x, i, 1e-5);
    EXPECT_NEAR(steps.y, 100000 - i, 1e-5);
    EXPECT_NEAR(steps.z, 37 * i, 1e-5);
  }
}

TEST(LasTest, DistinguishesBytesInColourFieldsFromWords) {
  const auto colours = [](std::vector<std::array<std::uint16_t, 3>> values) {
    LasFile file{.format = 2};
    for (std::size_t i = 0; i < values.size(); ++i)
      file.points.push_back({{static_cast<int>(i), 0, 0}, 1, false, values[i]});
    auto result = try_read("a.las", las_file(file));
    EXPECT_TRUE(result);
    return std::pair(result->points.colours, result->notes);
  };
  EXPECT_EQ(colours({{1, 2, 3}, {255, 0, 128}}),
            std::pair(std::vector<u8vec3>({{1, 2, 3}, {255, 0, 128}}),
                      std::vector<std::string>{"a.las: its colours are at most 255 and taken as "
                                               "8-bit, though their fields have 16 bits"}));
  // One value of the file decides for all; bytes times 256 and times 257 come back alike.
  EXPECT_EQ(colours({{1, 2, 3}, {0, 0, 0x100}, {0x8000, 0x8080, 0xFFFF}}),
            std::pair(std::vector<u8vec3>({{0, 0, 0}, {0, 0, 1}, {128, 128, 255}}),
                      std::vector<std::string>{
                          "a.las: its colours have 16 bits, of which the upper 8 are taken"}));
  EXPECT_EQ(colours({{255, 0, 0}, {0, 256, 0}}).first, std::vector<u8vec3>({{0, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(colours({{0, 0, 0}, {0, 0, 0}}),
            std::pair(std::vector<u8vec3>(), std::vector<std::string>()))
      << "fields that nobody filled in";
}

TEST(LasTest, LeavesOutWithheldPointsAndNoiseAndCountsThem) {
  for (const std::uint8_t format : {3, 7}) {
    LasFile file{.minor = 4, .format = format};
    file.points = {{{1, 0, 0}, 2},  {{2, 0, 0}, 2, true}, {{3, 0, 0}, 7},        {{4, 0, 0}, 18},
                   {{5, 0, 0}, 31}, {{6, 0, 0}, 7, true}, {{7, 0, 0}, 0, false}, {{8, 0, 0}, 12}};
    const auto result = try_read("a.las", las_file(file));
    ASSERT_TRUE(result);
    // Class 18 is noise only in formats 6 to 10; earlier formats leave it to users.
    const bool wide = format >= 6;
    EXPECT_EQ(result->points.size(), wide ? 4U : 5U);
    EXPECT_EQ(result->points.colours.size(), result->points.size());
    EXPECT_EQ(result->left_out, wide ? 4U : 3U);
    EXPECT_EQ(result->points_in_file, 8U);
    EXPECT_EQ(result->dropped_nonfinite, 0U);
    ASSERT_EQ(result->notes.size(), 2U);
    EXPECT_EQ(result->notes[1],
              fmt::format("a.las: 2 withheld points and {} of noise (class 7 or 18) are left out",
                          wide ? 2 : 1));
  }
  EXPECT_EQ(error("a.las", las_file({.points = {{{1, 2, 3}, 7}, {{4, 5, 6}, 7}}})),
            "a.las: holds no points to use: all 2 are marked as withheld or noise");
  EXPECT_EQ(error("a.las", las_file({})), "a.las: holds no points");
}

/// The x of the points, in steps, that a selection reads.
std::vector<int> selected(const LasFile& file, const PointSelection& selection) {
  const std::string bytes = las_file(file);
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  Progress progress;
  const auto result =
      read_bytes("a.las", {begin, begin + bytes.size()}, progress, {.selection = selection});
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  EXPECT_EQ(result->points.size() + result->not_selected + result->left_out, file.points.size());
  std::vector<int> steps;
  for (const dvec3& p : result->points.positions)
    steps.push_back(static_cast<int>(std::lround(p.x / file.scale[0])));
  return steps;
}

std::string selection_error(const std::string& name, const std::string& bytes,
                            const PointSelection& selection) {
  const auto* const begin = reinterpret_cast<const std::byte*>(bytes.data());
  Progress progress;
  const auto result =
      read_bytes(name, {begin, begin + bytes.size()}, progress, {.selection = selection});
  return result ? "no error" : result.error().message;
}

PointSelection of_classes(std::initializer_list<std::size_t> classes) {
  PointSelection selection;
  for (const std::size_t c : classes) selection.classes.set(c);
  return selection;
}

TEST(LasTest, SelectsClasses) {
  for (const std::uint8_t format : {3, 7}) {
    LasFile file{.minor = 4, .format = format};
    file.points = {{{1, 0, 0}, 2}, {{2, 0, 0}, 6},       {{3, 0, 0}, 7},
                   {{4, 0, 0}, 1}, {{5, 0, 0}, 6, true}, {{6, 0, 0}, 31}};
    EXPECT_EQ(selected(file, {}), (std::vector<int>{1, 2, 4, 6}));
    EXPECT_EQ(selected(file, of_classes({2, 6})), (std::vector<int>{1, 2}));
    // Noise is read by name; what is withheld never is.
    EXPECT_EQ(selected(file, of_classes({6, 7})), (std::vector<int>{2, 3}));
    EXPECT_EQ(selected(file, of_classes({31})), (std::vector<int>{6}));
    EXPECT_EQ(selection_error("a.las", las_file(file), of_classes({9, 12})),
              "a.las: no point is selected by --classes 9,12; its classes are 1, 2, 6, 7, 31");
  }
}

TEST(LasTest, SelectsReturns) {
  for (const std::uint8_t format : {0, 6}) {
    LasFile file{.minor = 4, .format = format};
    const std::array<std::array<unsigned, 2>, 7> returns = {
        {{1, 1}, {1, 3}, {2, 3}, {3, 3}, {0, 0}, {1, 2}, {5, 5}}};
    for (const auto& [number, count] : returns) {
      const auto x = static_cast<std::int32_t>(file.points.size() + 1);
      file.points.push_back({{x, 0, 0}, 2, false, {}, number, count});
    }
    const auto with = [&](ReturnChoice choice, unsigned number = 1) {
      return selected(file, {.returns = choice, .return_number = number});
    };
    EXPECT_EQ(with(ReturnChoice::First), (std::vector<int>{1, 2, 5, 6}));
    EXPECT_EQ(with(ReturnChoice::Last), (std::vector<int>{1, 4, 5, 7}));
    EXPECT_EQ(with(ReturnChoice::Single), (std::vector<int>{1, 5}));
    EXPECT_EQ(with(ReturnChoice::Numbered, 2), (std::vector<int>{3}));
    EXPECT_EQ(with(ReturnChoice::Numbered, 5), (std::vector<int>{7}));
    EXPECT_EQ(selection_error("a.las", las_file(file),
                              {.returns = ReturnChoice::Numbered, .return_number = 4}),
              "a.las: no point is selected by --returns 4; its classes are 2");
  }
}

TEST(LasTest, CropsWithTheBordersIncluded) {
  LasFile file{.format = 0, .scale = {1, 1, 1}, .offset = {0, 5e6, 0}};
  for (std::int32_t i = 0; i < 10; ++i) file.points.push_back({{i, i, 10 * i}});
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto crop = [](dvec3 low, dvec3 high) { return PointSelection{.crop = Bounds{low, high}}; };
  EXPECT_EQ(selected(file, crop({2, 5e6, -inf}, {5, 5e6 + 4, inf})), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(selected(file, crop({0, 5e6, 20}, {9, 5e6 + 9, 30})), (std::vector<int>{2, 3}));
  EXPECT_EQ(selection_error("a.las", las_file(file), crop({20, 0, -inf}, {30, 1, inf})),
            "a.las: no point lies in --crop 20,0,30,1; its points lie in "
            "0,5000000,9,5000009,0,90");
}

TEST(LasTest, OtherFormatsAreCroppedButHaveNoClasses) {
  const std::string text = "0 0 0\n1 0 0\n2 0 0\nnan 0 0\n";
  EXPECT_EQ(selection_error("a.xyz", text, of_classes({2})),
            "a.xyz: is XYZ text, which has no classes or returns; leave out --classes 2");
  EXPECT_EQ(selection_error("a.xyz", text, {.returns = ReturnChoice::Last}),
            "a.xyz: is XYZ text, which has no classes or returns; leave out --returns last");
  EXPECT_EQ(selection_error("a.xyz", text, {.crop = Bounds{{5, 5, 5}, {6, 6, 6}}}),
            "a.xyz: no point lies in --crop 5,5,6,6,5,6; its points lie in 0,0,2,0,0,0");
}

TEST(LasTest, SaysWhatIsWrongAndWhere) {
  const std::vector<LasPoint> two = {{{1, 2, 3}}, {{4, 5, 6}}};
  const std::string v12 = las_file({.format = 0, .records = 1, .points = two});
  const std::string v14 =
      las_file({.minor = 4, .format = 6, .records = 2, .extended_records = 1, .points = two});
  ASSERT_EQ(read("a.las", v12).size(), 2U);
  ASSERT_EQ(read("a.las", v14).size(), 2U);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    std::string bytes;
    std::string_view message;
  };
  const Case cases[] = {
      {"LASF....", "byte 8: the file ends within the header of 227 bytes"},
      {with_bytes(v12, 94, pack(std::uint16_t{226})),
       "byte 94: the header gives its own size as 226 bytes; it has at least 227, and the file "
       "326"},
      {with_bytes(v12, 94, pack(std::uint16_t{60000})),
       "byte 94: the header gives its own size as 60000 bytes; it has at least 227, and the file "
       "326"},
      {with_bytes(v14, 94, pack(std::uint16_t{235})),
       "byte 94: the header gives its own size as 235 bytes; it has at least 375, and the file "
       "620"},
      {with_bytes(v12, 104, pack(std::uint8_t{11})),
       "byte 104: states point record format 11, but there are 0 to 10"},
      {with_bytes(v12, 105, pack(std::uint16_t{19})),
       "byte 105: states 19 bytes per point, but those of point record format 0 have at least 20"},
      {with_bytes(v12, 105, pack(std::uint16_t{0})),
       "byte 105: states 0 bytes per point, but those of point record format 0 have at least 20"},
      {with_bytes(v12, 96, pack(327U)),
       "byte 96: the points are said to begin at byte 327, but the header ends at 227 and the file "
       "at 326"},
      {with_bytes(v12, 96, pack(100U)),
       "byte 96: the points are said to begin at byte 100, but the header ends at 227 and the file "
       "at 326"},
      {with_bytes(v12, 107, pack(0xFFFFFFF0U)),
       "byte 107: states 4294967280 points of 20 bytes, but the 40 bytes after byte 286 cannot "
       "hold them"},
      {with_bytes(v12, 107, pack(3U)),
       "byte 107: states 3 points of 20 bytes, but the 40 bytes after byte 286 cannot hold them"},
      {with_bytes(v14, 247, pack(std::uint64_t{1} << 62U)),
       "byte 247: states 4611686018427387904 points of 30 bytes, but the 127 bytes after byte 493 "
       "cannot hold them"},
      {with_bytes(v14, 107, pack(1U)), "byte 247: states 2 points, but byte 107 states 1"},
      {with_bytes(v12, 100, pack(2U)),
       "byte 286: variable length record 2 of the 2 that byte 100 states reaches beyond byte 286, "
       "where they end"},
      {with_bytes(v12, 100, pack(0xFFFFFFFFU)),
       "byte 286: variable length record 2 of the 4294967295 that byte 100 states reaches beyond "
       "byte 286, where they end"},
      {with_bytes(v12, 227 + 20, pack(std::uint16_t{6})),
       "byte 227: variable length record 1 of the 1 that byte 100 states reaches beyond byte 286, "
       "where they end"},
      {with_bytes(v14, 553 + 20, pack(std::uint64_t{0xFFFFFFFFFFFFFFFFU})),
       "byte 553: variable length record 1 of the 1 that byte 243 states reaches beyond byte 620, "
       "where they end"},
      {with_bytes(v14, 235, pack(std::uint64_t{552})),
       "byte 235: extended variable length records are said to begin at byte 552, but the points "
       "end at 553 and the file at 620"},
      {with_bytes(v14, 235, pack(std::uint64_t{621})),
       "byte 235: extended variable length records are said to begin at byte 621, but the points "
       "end at 553 and the file at 620"},
      {with_bytes(v12, 139, pack(nan)),
       "byte 139: the scale of y is nan, but it must be a number above 0"},
      {with_bytes(v12, 147, pack(0.0)),
       "byte 147: the scale of z is 0, but it must be a number above 0"},
      {with_bytes(v12, 131, pack(-0.01)),
       "byte 131: the scale of x is -0.01, but it must be a number above 0"},
      {with_bytes(v12, 163, pack(-std::numeric_limits<double>::infinity())),
       "byte 163: the offset of y is -inf, but it must be a number"},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(error("a.las", c.bytes),
              fmt::format("a.las: {}; the file is truncated or damaged", c.message));
  }
  EXPECT_EQ(error("a.las", with_bytes(v12, 25, "\x05")),
            "a.las: byte 24: is LAS 1.5, but LAS 1.1 to 1.4 can be read; save it as one");
  EXPECT_EQ(error("a.las", "not one"),
            "a.las: does not begin with 'LASF', so it is not a LAS file");
}

TEST(LasTest, SaysWhatToDoWithLazAndE57) {
  const std::string las = las_file({.minor = 4, .format = 6, .points = {{{1, 2, 3}}}});
  const std::string packed = error("a.copc.laz", with_bytes(las, 104, "\x86"));
  if (can_unpack_laz()) {
    EXPECT_TRUE(packed.ends_with("the file is truncated or damaged")) << packed;
  } else {
    EXPECT_EQ(packed,
              "a.copc.laz: is packed as LAZ (or COPC, which is LAZ too), which this build cannot "
              "read: it was built without LASzip (Debian 13: liblaszip-dev); unpack it to LAS "
              "first, with `laszip -i IN.laz -o OUT.las` or `pdal translate IN.laz OUT.las`");
  }
  EXPECT_EQ(error("a.e57", "ASTM-E57....."),
            "a.e57: E57 files cannot be read; convert it first, with `pdal translate "
            "IN.e57 OUT.las` or CloudCompare");
}

}  // namespace
}  // namespace relief::test

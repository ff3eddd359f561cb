// Which points are read, rasters, and pipes, as users ask for them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/cli/json_test.h"
#include "tests/cli/run_relief.h"
#include "tests/preprocess/raster/raster_files.h"
#include "tests/preprocess/readers/las_files.h"

namespace relief::test {
namespace {

class InputsTest : public CliTest {
 protected:
  /// Runs a line of the shell, in which $R is the command and $F the test's folder.
  int shell(const std::string& line) {
    const std::string command =
        fmt::format("R='{}'; F='{}'; {} 2> '{}'", RELIEF_PROGRAM, path(""), line, path("errors"));
    return WEXITSTATUS(std::system(command.c_str()));
  }
  std::string errors() { return file_bytes(path("errors")); }

  /// A plane of ground (class 2) below one of leaves (class 5), of many points.
  std::string write_las() {
    LasFile file{.format = 0};
    for (std::int32_t j = 0; j < 60; ++j) {
      for (std::int32_t i = 0; i < 60; ++i) {
        file.points.push_back({{10 * i, 10 * j, (i + j) % 3}, 2, false, {}, 2, 2});
        file.points.push_back({{10 * i, 10 * j, 500 + (i * j) % 3}, 5, false, {}, 1, 2});
      }
    }
    return write("scan.las", las_file(file));
  }
};

TEST_F(InputsTest, PointsAreSelectedByClassReturnAndBox) {
  const std::string las = write_las();
  const auto points = [&](const std::string& options) {
    EXPECT_EQ(shell(fmt::format("$R convert {} -o $F/out.relief --noise 0 --json {} > $F/json", las,
                                options)),
              0)
        << errors();
    const auto report = nlohmann::json::parse(file_bytes(path("json")));
    EXPECT_EQ(report["points"].get<int>() + report["points_not_selected"].get<int>(), 7200);
    return report["points"].get<int>();
  };
  EXPECT_EQ(points(""), 7200);
  EXPECT_EQ(points("--classes 2"), 3600);
  EXPECT_EQ(points("--returns first"), 3600);
  EXPECT_EQ(points("--classes 2,5 --returns last --crop 0,0,2.9,5.9"), 30 * 60);
  EXPECT_EQ(shell(fmt::format("$R convert {} -o $F/no.relief --classes 9", las)), 1);
  EXPECT_EQ(errors(),
            fmt::format("relief: {}: no point is selected by --classes 9; its classes are "
                        "2, 5\n",
                        las));
  EXPECT_FALSE(std::filesystem::exists(path("no.relief")));
  EXPECT_EQ(shell(fmt::format("$R convert {} -o $F/no.relief --crop 9,9,1,1", las)), 2);
  EXPECT_EQ(shell(fmt::format("$R convert {} -o $F/no.relief --returns none", las)), 2);
  EXPECT_EQ(shell(fmt::format("$R convert {} -o $F/no.relief --classes 2,256", las)), 2);
  EXPECT_EQ(shell("$R export $F/out.relief -o $F/out.ply --crop 0,0,1,1"), 1);
  EXPECT_NE(errors().find("is a patch file, which has no points to select"), std::string::npos);
}

TEST_F(InputsTest, ARasterIsConvertedAndDrawn) {
  write("grid.csv", csv_text(hills(40, 30)));
  ASSERT_EQ(shell("$R convert $F/grid.csv -o $F/grid.relief --json > $F/json"), 0) << errors();
  const auto report = nlohmann::json::parse(file_bytes(path("json")));
  EXPECT_EQ(report["samples"], report["points"]);
  EXPECT_EQ(report["error_max"], 0.0);
  EXPECT_TRUE(report["psnr_db"].is_null());
  EXPECT_EQ(shell("$R render $F/grid.csv -o $F/a.png --size 64x64 > $F/out"), 0) << errors();
  EXPECT_EQ(shell("$R render $F/grid.csv -o $F/b.png --size 64x64 --engine ewa > $F/out"), 0)
      << errors();
  EXPECT_EQ(shell("$R export $F/grid.csv -o $F/a.ply > $F/out"), 0) << errors();
  EXPECT_EQ(shell("$R convert $F/grid.csv -o $F/no.relief --memory 1G"), 1);
  EXPECT_NE(errors().find("leave out --memory"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(path("no.relief")));
}

TEST_F(InputsTest, PipesGiveWhatFilesGive) {
  write("grid.csv", csv_text(hills(40, 30)));
  ASSERT_EQ(shell("$R convert $F/grid.csv -o $F/file.relief > $F/out"), 0) << errors();
  ASSERT_EQ(shell("cat $F/grid.csv | $R convert - --format grid -o - > $F/pipe.relief"), 0)
      << errors();
  EXPECT_EQ(file_bytes(path("pipe.relief")), file_bytes(path("file.relief")));
  EXPECT_NE(errors().find("samples "), std::string::npos) << "the report is on standard error";
  ASSERT_EQ(shell("$R render $F/file.relief -o $F/file.png --size 64x64 > $F/out"), 0) << errors();
  ASSERT_EQ(shell("cat $F/file.relief | $R render - -o - --size 64x64 > $F/pipe.png"), 0)
      << errors();
  EXPECT_EQ(file_bytes(path("pipe.png")), file_bytes(path("file.png")));
  ASSERT_EQ(shell("$R export $F/file.relief -o $F/file.ply > $F/out"), 0) << errors();
  ASSERT_EQ(shell("$R export - -o - < $F/file.relief > $F/pipe.ply"), 0) << errors();
  EXPECT_EQ(file_bytes(path("pipe.ply")), file_bytes(path("file.ply")));
  ASSERT_EQ(shell("cat $F/file.relief | $R info - > $F/out"), 0) << errors();
}

TEST_F(InputsTest, PipesThatCannotWorkSaySo) {
  EXPECT_EQ(shell("$R convert - -o $F/no.relief < /dev/null"), 1);
  EXPECT_EQ(errors(), "relief: -: the file is empty\n");
  EXPECT_EQ(shell("echo 1 2 3 | $R convert - -o $F/no.relief"), 1);
  EXPECT_NE(errors().find("--format names one"), std::string::npos);
  EXPECT_EQ(shell("echo 1 2 3 | $R convert - --format nothing -o $F/no.relief"), 2);
  EXPECT_EQ(shell("echo 1 2 3 | $R convert - --format xyz -o - --json > $F/no.relief"), 2);
  EXPECT_EQ(shell("echo 1 2 3 | $R convert - --format xyz -o - --memory 1G > $F/out"), 2);
  // Nothing comes out after a failure.
  EXPECT_EQ(shell("echo 1 2 3 | $R convert - --format xyz -o - > $F/out"), 1);
  EXPECT_EQ(file_bytes(path("out")), "");
}

}  // namespace
}  // namespace relief::test

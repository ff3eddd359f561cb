// relief render --explain and --explain-cost, from the file to the report.
#include <cstdint>
#include <string>

#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using Json = nlohmann::json;

class ExplainCost : public JsonTest {
 protected:
  std::string write_patches() {
    const std::string scan = write_knot(3000);
    EXPECT_EQ(run_relief({"convert", scan, "-o", path("knot.relief"), "--overlap", "1"}).exit_code,
              0);
    return path("knot.relief");
  }
};

TEST_F(ExplainCost, ReportsWhatWasReadOfPatchFiles) {
  const std::string file = write_patches();
  const auto read = [&](const std::string& material, const std::string& output) {
    return run_json({"render", file, "-o", path(output), "--material", material, "--size", "64x64",
                     "--explain"})["explain"]["read_bytes"];
  };
  const Json unlit = read("unlit", "a.png");
  EXPECT_GT(unlit["heights"], 0);
  EXPECT_EQ(unlit["normals"], 0);
  EXPECT_GT(read("lit", "a.png")["normals"], 0);
  EXPECT_GT(read("unlit", "a.exr")["normals"], 0) << "an EXR has normals by default";
  EXPECT_EQ(run_relief({"convert", path("knot.ply"), "-o", file, "--seams"}).exit_code, 0);
  EXPECT_GT(read("unlit", "a.png")["normals"], 0) << "seams follow them";
  // What is converted in memory has no sections.
  const Json scan =
      run_json({"render", path("knot.ply"), "-o", path("a.png"), "--size", "64x64", "--explain"});
  EXPECT_TRUE(scan["explain"]["read_bytes"].is_null());
}

TEST_F(ExplainCost, HasARowForEachFeature) {
  const std::string file = write_patches();
  const Json plain =
      run_json({"render", file, "-o", path("a.png"), "--size", "64x64", "--explain"});
  EXPECT_FALSE(plain["explain"].contains("costs")) << "only where it is asked for";
  const Json report = run_json({"render", file, "-o", path("b.png"), "--size", "64x64",
                                "--material", "lit", "--explain-cost", "--frames", "3"});
  const Json& costs = report["explain"]["costs"];
  EXPECT_EQ(costs["turns"], 3);
  expect_keys(costs["whole"], {"gpu_bytes", "file_bytes", "passes", "shader_lines", "frame_ms"});
  bool has_light = false;
  for (const Json& row : costs["features"]) {
    expect_keys(row, {"feature", "instead", "gpu_bytes", "file_bytes", "passes", "saved_passes",
                      "shader_lines", "frame_ms", "spread_ms"});
    if (row["feature"] != "light") continue;
    has_light = true;
    EXPECT_EQ(row["file_bytes"], report["explain"]["read_bytes"]["normals"]);
    EXPECT_GT(row["gpu_bytes"], 0);
    EXPECT_GT(row["shader_lines"], 0);
  }
  EXPECT_TRUE(has_light);
  EXPECT_EQ(costs["rest"]["file_bytes"].get<std::uint64_t>() +
                report["explain"]["read_bytes"]["normals"].get<std::uint64_t>() +
                report["explain"]["read_bytes"]["colours"].get<std::uint64_t>(),
            costs["whole"]["file_bytes"].get<std::uint64_t>());
}

TEST_F(ExplainCost, ChangesNoImage) {
  const std::string file = write_patches();
  // Explained images have one sample a pixel.
  ASSERT_EQ(run_relief({"render", file, "-o", path("a.png"), "--size", "64x64", "--samples", "1"})
                .exit_code,
            0);
  ASSERT_EQ(run_relief({"render", file, "-o", path("b.png"), "--size", "64x64", "--explain-cost",
                        "--frames", "1"})
                .exit_code,
            0);
  EXPECT_EQ(file_bytes(path("a.png")), file_bytes(path("b.png")));
}

TEST_F(ExplainCost, PrintsATable) {
  const Outcome run = run_relief({"render", write_patches(), "-o", path("a.png"), "--size", "64x64",
                                  "--explain-cost", "--frames", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* const text : {"what features cost", "whole frame", "without all of these",
                                 "levels of detail", "GPU bytes", "read of patch files"})
    EXPECT_NE(run.out.find(text), std::string::npos) << text << " in " << run.out;
}

TEST_F(ExplainCost, IsRefusedWhereFeaturesCannotBeLeftOut) {
  const Outcome run = run_relief(
      {"render", write_patches(), "-o", path("a.png"), "--engine", "surfel", "--explain-cost"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("--explain-cost"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("surfel"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace relief::test

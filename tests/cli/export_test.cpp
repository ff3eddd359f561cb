// relief export, through the command alone.
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "preprocess/readers/read_points.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

class ExportCommand : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    scan_ = path("knot.relief");
    const Outcome run = run_relief({"convert", write_knot(5000), "-o", scan_, "--overlap", "1"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  json run_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return json::parse(run.out, nullptr, false);
  }

  static Points read(const std::string& path) {
    Progress progress;
    auto result = read_points(path, progress);
    EXPECT_TRUE(result) << result.error().message;
    return result ? std::move(result->points) : Points();
  }

  std::string scan_;
};

TEST_F(ExportCommand, WritesEachFormatWithAllSamples) {
  const json info = run_json({"info", scan_});
  for (const std::string name : {"a.ply", "a.obj", "a.glb"}) {
    const json told = run_json({"export", scan_, "-o", path(name)});
    EXPECT_EQ(told["output"], path(name));
    EXPECT_EQ(told["vertices"], info["samples"]) << name;
    EXPECT_EQ(told["file_bytes"], std::filesystem::file_size(path(name)));
    const bool is_mesh = name != "a.ply";
    EXPECT_EQ(told["as"], is_mesh ? "mesh" : "points") << name;
    const Points points = read(path(name));
    EXPECT_EQ(points.size(), told["vertices"]) << name;
    EXPECT_EQ(points.triangles.size(), told["triangles"]) << name;
    EXPECT_EQ(points.normals.size(), points.size()) << name;
    EXPECT_EQ(points.colours.size(), told["colours"] ? points.size() : 0) << name;
    EXPECT_EQ(is_mesh, !points.triangles.empty()) << name;
  }
  EXPECT_GT(run_json({"export", scan_, "-o", path("b.ply"), "--as", "mesh"})["triangles"], 5000);
  EXPECT_EQ(run_json({"export", scan_, "-o", path("b.obj"), "--as", "points"})["triangles"], 0);
  EXPECT_EQ(run_json({"export", scan_, "-o", path("b.glb"), "--as", "points"})["triangles"], 0);
}

TEST_F(ExportCommand, TheMeshIsTheSurface) {
  ASSERT_EQ(run_relief({"export", scan_, "-o", path("a.glb")}).exit_code, 0);
  const Points mesh = read(path("a.glb"));
  // Corners run against the clock, seen from where the normals point to.
  std::size_t along = 0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t[0]];
    const glm::dvec3 n = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    along += glm::dot(n, glm::dvec3(mesh.normals[t[0]])) > 0.0 ? 1U : 0U;
  }
  // Nearly all: at a coarse sample's crease a normal may lean past a triangle.
  EXPECT_GT(static_cast<double>(along), 0.99 * static_cast<double>(mesh.triangles.size()));
}

TEST_F(ExportCommand, RefusesInOneSentenceAndLeavesNothing) {
  expect_refused({"export", path("missing.relief"), "-o", path("a.ply")}, "missing.relief");
  expect_refused({"export", scan_, "-o", path("no/such/a.ply")}, "no directory");
  const std::string ply = write("same.ply", "ply\n");
  expect_refused({"export", ply, "-o", ply}, "is also the input");
  RunOptions full_disk;
  full_disk.largest_file = 10000;
  for (const std::string name : {"a.ply", "a.obj", "a.glb"})
    expect_refused({"export", scan_, "-o", path(name)}, name, full_disk);
}

}  // namespace
}  // namespace relief::test

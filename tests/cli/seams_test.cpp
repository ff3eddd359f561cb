// A scan to patches that meet at seams, and their image, through the command alone.
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "preprocess/readers/read_points.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

class SeamsCommand : public CliTest {
 protected:
  json run_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    json parsed = json::parse(run.out, nullptr, false);
    return parsed.is_object() ? parsed : json::object();
  }
  void draw(const std::string& model, const std::string& image, const std::string& engine) {
    std::vector<std::string> arguments{"render", model,       "-o", image,    "--engine",
                                       engine,   "--samples", "1",  "--size", "320x256"};
    if (engine == "onepass") arguments.insert(arguments.end(), {"--pixels-per-sample", "0"});
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
};

TEST_F(SeamsCommand, MeetWithoutMarginsOrHoles) {
  const std::string scan = write_knot(20000);
  const json overlap = run_json({"convert", scan, "-o", path("overlap.relief"), "--overlap", "1"});
  const json seams = run_json({"convert", scan, "-o", path("seams.relief"), "--seams"});
  // Margins took a fifth of the samples; the spacing is finer instead.
  EXPECT_LT(seams["spacing"], overlap["spacing"]);
  // As many as asked for (kFewestSamplesPerPoint) to 2 %: counting nodes comes within about 1 %.
  EXPECT_NEAR(seams["samples"].get<double>(), 1.1 * 20000.0, 440.0);
  // 72.0 dB when written, with margins 71.4.
  EXPECT_GT(seams["psnr_db"], 70.0);
  EXPECT_EQ(seams["uncovered_points"], 0);
  EXPECT_EQ(run_json({"info", path("seams.relief")})["seams"], true);
  EXPECT_EQ(run_json({"info", path("overlap.relief")})["seams"], false);

  draw(path("seams.relief"), path("onepass.exr"), "onepass");
  draw(path("seams.relief"), path("truth.exr"), "raytrace");
  const json compared = run_json({"compare", path("onepass.exr"), path("truth.exr")});
  // Both draw the same triangles: what differs are pixels whose middle an edge meets.
  EXPECT_EQ(compared["holes"], 0);
  EXPECT_LE(compared["border_missing"].get<int>() + compared["border_extra"].get<int>(), 20);
  EXPECT_GT(compared["psnr_db"], 50.0);  // 58.3 when written
}

TEST_F(SeamsCommand, ExportOneClosedMesh) {
  run_json({"convert", write_knot(20000), "-o", path("knot.relief"), "--seams"});
  for (const std::string name : {"knot.ply", "knot.obj", "knot.glb"}) {
    const json told = run_json({"export", path("knot.relief"), "-o", path(name), "--as", "mesh"});
    Progress progress;
    auto read = read_points(path(name), progress);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->points.size(), told["vertices"]);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : read->points.triangles) {
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_TRUE(edges.insert({t[c], t[(c + 1) % 3]}).second) << name;
    }
    std::size_t open = 0;
    for (const auto& [from, to] : edges) open += edges.contains({to, from}) ? 0U : 1U;
    EXPECT_EQ(open, 0U) << name;
    // Euler: it is a torus, however knotted.
    EXPECT_EQ(read->points.size() + read->points.triangles.size(), edges.size() / 2) << name;
  }
  const json points = run_json({"export", path("knot.relief"), "-o", path("points.ply")});
  EXPECT_EQ(points["vertices"], run_json({"info", path("knot.relief")})["samples"]);
}

TEST_F(SeamsCommand, DoNotDependOnThreads) {
  const std::string scan = write_knot(5000);
  for (const std::string threads : {"1", "3"})
    run_json({"convert", scan, "-o", path(threads + ".relief"), "--seams", "--threads", threads});
  EXPECT_EQ(file_bytes(path("1.relief")), file_bytes(path("3.relief")));
}

TEST_F(SeamsCommand, ExcludeMargins) {
  const Outcome run = run_relief(
      {"convert", write_knot(1000), "-o", path("out.relief"), "--seams", "--overlap", "2"});
  EXPECT_EQ(run.exit_code, 2);
}

TEST_F(SeamsCommand, AreTheDefaultOfScansWithFaces) {
  run_json({"convert", write_knot(3000), "-o", path("points.relief"), "--seams"});
  run_json({"export", path("points.relief"), "-o", path("mesh.ply"), "--as", "mesh"});
  for (const bool overlap : {false, true}) {
    std::vector<std::string> arguments{"convert", path("mesh.ply"), "-o", path("mesh.relief")};
    if (overlap) arguments.insert(arguments.end(), {"--overlap", "1"});
    run_json(arguments);
    EXPECT_EQ(run_json({"info", path("mesh.relief")})["seams"], !overlap);
  }
}

TEST_F(SeamsCommand, AreTheDefaultOfPointsOfAClosedBody) {
  run_json({"convert", write_knot(3000), "-o", path("closed.relief")});
  EXPECT_EQ(run_json({"info", path("closed.relief")})["seams"], true);
  run_json({"convert", write_knot(3000), "-o", path("overlap.relief"), "--overlap", "1"});
  EXPECT_EQ(run_json({"info", path("overlap.relief")})["seams"], false);
  std::string sheet =
      "ply\nformat ascii 1.0\nelement vertex 1600\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (int k = 0; k < 1600; ++k)
    sheet += std::to_string(k % 40) + " " + std::to_string(k / 40) + " 0\n";
  run_json({"convert", write("sheet.ply", sheet), "-o", path("sheet.relief")});
  EXPECT_EQ(run_json({"info", path("sheet.relief")})["seams"], false);
}

}  // namespace
}  // namespace relief::test

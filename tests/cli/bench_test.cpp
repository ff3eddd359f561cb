// relief bench and relief render --explain, as a user runs them. No test looks at how long it took.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

json parse(const Outcome& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  json parsed = json::parse(run.out, nullptr, false);
  EXPECT_TRUE(parsed.is_object()) << run.out;
  return parsed;
}

/// A square of 2 (n - 1)^2 triangles, in XY.
std::string square_off(int n) {
  std::string off =
      "OFF\n" + std::to_string(n * n) + " " + std::to_string(2 * (n - 1) * (n - 1)) + " 0\n";
  for (int k = 0; k < n * n; ++k)
    off += std::to_string(k % n) + " " + std::to_string(k / n) + " 0\n";
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i;
      off += "3 " + std::to_string(a) + " " + std::to_string(a + 1) + " " +
             std::to_string(a + n + 1) + "\n3 " + std::to_string(a) + " " +
             std::to_string(a + n + 1) + " " + std::to_string(a + n) + "\n";
    }
  }
  return off;
}

/// 4 x 4 x 4 nodes from 0 to 3.
std::string small_nrrd() {
  std::string text = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: ascii\n\n";
  for (int k = 0; k < 64; ++k) text += std::to_string(k) + " ";
  return text;
}

class BenchCommand : public CliTest {
 protected:
  static std::vector<std::string> small(const std::string& scene,
                                        const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"bench",    scene, "--size", "64x48",
                                       "--frames", "1",   "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(BenchCommand, ListsEveryMeshMethod) {
  const std::string scene = write("square.off", square_off(30));
  const json result = parse(run_relief(small(scene, {"--plot", path("bench.svg")})));
  EXPECT_EQ(result["width"], 64);
  EXPECT_EQ(result["height"], 48);
  EXPECT_EQ(result["frames"], 1);
  EXPECT_EQ(result["mesh_triangles"], 2 * 29 * 29);
  EXPECT_TRUE(result["mesh_ms"].is_number());
  EXPECT_TRUE(result["shading_bound_ms"].is_number());
  EXPECT_GT(result["covered_pixels"], 100);
  EXPECT_GE(result["samples"], 800);
  ASSERT_EQ(result["rows"].size(), 11U);
  int defaults = 0;
  for (const json& row : result["rows"]) {
    for (const char* key :
         {"engine", "primitive", "interpolation", "radius_factor", "level_policy", "default",
          "frame_ms", "gpu_ms", "fragments", "overdraw", "gpu_bytes", "psnr_db", "psnr_mirror_db",
          "flip_mean", "holes", "ratio_to_multipass", "ratio_to_shading_bound", "ratio_to_mesh"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_TRUE(row["level_policy"].is_string());
    const bool onepass = row["engine"] == "onepass";
    EXPECT_EQ(row["radius_factor"].is_null(), onepass);
    EXPECT_EQ(row["interpolation"].is_null(), !onepass);
    EXPECT_EQ(row["holes"], 0);
    EXPECT_TRUE(row["psnr_db"].is_number());
    // Flat, of one normal: the same where both cover, up to the rounding of a normal to 16 bits and
    // of a colour to half a float, 2^-11 of it. One 8-bit step off everywhere would be 48 dB.
    EXPECT_TRUE(row["psnr_covered_db"].is_null() || row["psnr_covered_db"] > 60.0)
        << row["psnr_covered_db"];
    defaults += row["default"] == true ? 1 : 0;
    EXPECT_GE(row["gpu_bytes"], row["model_bytes"]);
  }
  EXPECT_EQ(defaults, 1);
  const std::string plot = file_bytes(path("bench.svg"));
  EXPECT_EQ(plot.rfind("<svg", 0), 0U);
  EXPECT_NE(plot.find("multipass sprite radius-factor 2"), std::string::npos);
}

// The default row is what `relief render` draws: the same settings, pixels and fragments.
TEST_F(BenchCommand, TheDefaultRowMatchesRender) {
  const std::string scene = write_knot(3000);
  const json result = parse(run_relief(small(scene)));
  const json render = parse(run_relief({"render", scene, "-o", path("knot.png"), "--size", "64x48",
                                        "--frames", "1", "--material", "lit", "--json"}));
  for (const json& row : result["rows"]) {
    if (row["default"] != true) continue;
    for (const char* key :
         {"engine", "primitive", "interpolation", "covered_pixels", "fragments", "radius_factor"})
      EXPECT_EQ(row[key], render[key]) << key;
  }
  EXPECT_TRUE(result["mesh_ms"].is_null());  // a scan without faces
  EXPECT_TRUE(result["mesh_triangles"].is_null());
  EXPECT_TRUE(result["rows"][0]["ratio_to_mesh"].is_null());
}

TEST_F(BenchCommand, TakesTheFirstViewOfAScene) {
  write("square.off", square_off(20));
  const std::string scene = write("scene.json",
                                  R"({"models": [{"file": "square.off"}], "size": [40, 30],
      "views": [{"name": "front", "engine": "multipass"}, {"name": "side", "orbit": [90, 0]}]})");
  const Outcome run = run_relief({"bench", scene, "--frames", "1"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("view front"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("40x30"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("* onepass"), std::string::npos) << run.out;
}

TEST_F(BenchCommand, DrawsTheLevelsOfASceneBesideTheDefault) {
  write("square.off", square_off(20));
  const std::string scene = write("scene.json",
                                  R"({"models": [{"file": "square.off"}], "pixels-per-sample": 3,
      "views": [{"name": "front"}]})");
  const json result = parse(run_relief(small(scene)));
  std::set<std::string> policies;
  int defaults = 0;
  for (const json& row : result["rows"]) {
    if (row["primitive"] == "cell") policies.insert(row["level_policy"]);
    defaults += row["default"] == true ? 1 : 0;
  }
  EXPECT_EQ(policies,
            (std::set<std::string>{"finest", "at most 3 pixels a sample",
                                   "at most 4 pixels a sample", "at most 8 pixels a sample"}));
  EXPECT_EQ(defaults, 1);
}

TEST_F(BenchCommand, SweepsASpacing) {
  const json result =
      parse(run_relief(small(write("square.off", square_off(30)), {"--sweep", "spacing=2,0.5"})));
  EXPECT_EQ(result["sweep"], "spacing");
  const json& rows = result["rows"];
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["default"], true);
  EXPECT_EQ(rows[1]["engine"], "multipass");
  EXPECT_EQ(rows[1]["ratio_to_multipass"], 1.0);
  EXPECT_EQ(rows[2]["sweep_value"], 2.0);
  EXPECT_EQ(rows[3]["sweep_value"], 0.5);
  for (const json& row : {rows[2], rows[3]}) EXPECT_EQ(row["default"], false);
  // A quarter of the spacing is 16 times the samples, but for those at the rim and the overlap of
  // patches: 8 to 20.
  EXPECT_GT(rows[3]["samples"], 8 * rows[2]["samples"].get<int>());
  EXPECT_LT(rows[3]["samples"], 20 * rows[2]["samples"].get<int>());
}

TEST_F(BenchCommand, SweepsARadiusFactor) {
  const json result =
      parse(run_relief(small(write_knot(3000), {"--sweep", "radius-factor=1.5,3"})));
  ASSERT_EQ(result["rows"].size(), 4U);
  EXPECT_EQ(result["rows"][2]["radius_factor"], 1.5);
  EXPECT_EQ(result["rows"][3]["radius_factor"], 3.0);
  EXPECT_GT(result["rows"][3]["fragments"], result["rows"][2]["fragments"]);
}

TEST_F(BenchCommand, SweepsPixelsPerSample) {
  const json result =
      parse(run_relief(small(write_knot(3000), {"--sweep", "pixels-per-sample=0,16"})));
  EXPECT_EQ(result["sweep"], "pixels-per-sample");
  const json& rows = result["rows"];
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["default"], true);
  EXPECT_EQ(rows[2]["level_policy"], "finest");
  EXPECT_EQ(rows[3]["level_policy"], "at most 16 pixels a sample");
  for (const json& row : {rows[2], rows[3]}) {
    EXPECT_EQ(row["engine"], "onepass");
    EXPECT_EQ(row["primitive"], "cell");
  }
}

/// Rows by name.
std::map<std::string, json> by_name(const json& rows) {
  std::map<std::string, json> named;
  for (const json& row : rows) named[row["name"].get<std::string>()] = row;
  EXPECT_EQ(named.size(), rows.size()) << "a name for each row";
  return named;
}

// Those that there are today; more engines add rows.
const std::vector<std::string> kOnOpenGl{"onepass quad direct", "onepass quad corrected",
                                         "onepass cell corrected", "multipass quad"};

TEST_F(BenchCommand, ComparesAllEngines) {
  const std::string scene = write("square.off", square_off(30));
  const json result =
      parse(run_relief(small(scene, {"--engines", "all", "--plot", path("engines.svg")})));
  EXPECT_EQ(result["truth"], "faces");
  EXPECT_TRUE(result["mesh_ms"].is_number());
  EXPECT_TRUE(result["shading_bound_ms"].is_number());
  const auto rows = by_name(result["rows"]);
  for (const auto& [name, row] : rows) {
    EXPECT_GT(row["frame_ms"], 0.0) << name;
    EXPECT_GE(row["frames"], 1) << name;
    EXPECT_GT(row["samples"], 0) << name;
    for (const char* key : {"psnr_db", "psnr_mirror_db", "flip_mean", "normal_rms_deg", "holes",
                            "border_missing", "border_extra", "covered_pixels"})
      EXPECT_TRUE(row[key].is_number()) << name << " " << key;
    EXPECT_EQ(row["default"], name == "onepass cell corrected") << name;
  }
  for (const std::string& name : kOnOpenGl) {
    ASSERT_TRUE(rows.contains(name)) << name;
    EXPECT_EQ(rows.at(name)["input"], "samples") << name;
    EXPECT_GT(rows.at(name)["gpu_bytes"], 0) << name;
    // A plane, drawn of patches: normals are off by their rounding to 16 bits only.
    EXPECT_LT(rows.at(name)["normal_rms_deg"], 0.01) << name;
  }
  ASSERT_TRUE(rows.contains("ewa"));
  EXPECT_EQ(rows.at("ewa")["input"], "points");
  EXPECT_EQ(rows.at("ewa")["samples"], 900);
  EXPECT_TRUE(rows.at("ewa")["gpu_bytes"].is_null());
  EXPECT_TRUE(rows.at("ewa")["ratio_to_multipass"].is_number());
  EXPECT_EQ(rows.at("multipass quad")["ratio_to_multipass"], 1.0);
  const std::string plot = file_bytes(path("engines.svg"));
  EXPECT_EQ(plot.rfind("<svg", 0), 0U);
  EXPECT_NE(plot.find(">ewa</text>"), std::string::npos);
  EXPECT_NE(plot.find("pixels that both cover"), std::string::npos);
}

// A scan without faces: patches are held against their own triangles, and the report says so.
TEST_F(BenchCommand, ComparesEnginesOnAScanWithoutFaces) {
  const std::string scene = write_knot(3000);
  const json result = parse(run_relief(small(scene, {"--engines", "ewa,onepass,ewa"})));
  EXPECT_EQ(result["truth"], "patches");
  EXPECT_TRUE(result["mesh_ms"].is_null());
  const auto rows = by_name(result["rows"]);
  EXPECT_EQ(result["rows"][0]["engine"], "onepass") << "in the registry's order";
  EXPECT_TRUE(rows.contains("ewa"));
  EXPECT_FALSE(rows.contains("multipass quad"));
  EXPECT_EQ(rows.at("ewa")["input"], "points");
  const std::string vertices =
      fmt::format("element vertex {}\n", rows.at("ewa")["samples"].get<std::uint64_t>());
  EXPECT_NE(file_bytes(scene).find(vertices), std::string::npos) << vertices;
  EXPECT_TRUE(rows.at("ewa")["ratio_to_multipass"].is_null());
  const Outcome text =
      run_relief({"bench", scene, "--size", "64x48", "--frames", "1", "--engines", "all"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("the patches' own triangles"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("* onepass cell corrected"), std::string::npos) << text.out;
}

TEST_F(BenchCommand, ComparesEnginesOnSamplesOfAPatchFile) {
  const std::string patches = path("square.relief");
  ASSERT_EQ(run_relief({"convert", write("square.off", square_off(20)), "-o", patches}).exit_code,
            0);
  const json result = parse(run_relief(small(patches, {"--engines", "ewa"})));
  ASSERT_GE(result["rows"].size(), 1U);
  EXPECT_EQ(result["renderer"], "CPU");
  EXPECT_EQ(result["truth"], "patches");
  EXPECT_TRUE(result["shading_bound_ms"].is_null());
  EXPECT_EQ(result["rows"][0]["input"], "samples");
  EXPECT_GT(result["rows"][0]["frame_ms"], 0.0);
  EXPECT_TRUE(result["rows"][0]["gpu_ms"].is_null());
}

TEST_F(BenchCommand, RefusesEnginesThatItCannotCompare) {
  const std::string scene = write("square.off", square_off(5));
  for (const char* engines : {"none", "raytrace", "volume", "", "onepass,", "all,ewa"}) {
    const Outcome run = run_relief({"bench", scene, "--engines", engines});
    EXPECT_EQ(run.exit_code, 2) << engines;
    EXPECT_NE(run.err.find("onepass, multipass, ewa"), std::string::npos) << run.err;
  }
  EXPECT_EQ(
      run_relief({"bench", scene, "--engines", "all", "--sweep", "radius-factor=1,2"}).exit_code,
      2);
  expect_refused({"bench", write("a.nrrd", small_nrrd()), "--engines", "all"}, "no --engines");
  // Found before anything is timed.
  expect_refused({"bench", scene, "--engines", "all", "--opacity", "0.5"}, "opacity");
}

TEST_F(BenchCommand, RefusesImpossibleOptions) {
  expect_refused({"bench", path("none.ply")}, "none.ply");
  const std::string scene = write("square.off", square_off(5));
  expect_refused({"bench", scene, "--plot", path("no/such/folder.svg")}, "folder.svg");
  expect_refused({"bench", scene, "--env", path("none.hdr")}, "none.hdr");
  EXPECT_EQ(run_relief({"bench", scene, "--plot", path("plot.png")}).exit_code, 2);
  EXPECT_EQ(run_relief({"bench", scene, "--frames", "0"}).exit_code, 2);
  for (const char* sweep : {"spacing", "spacing=", "spacing=1,", "spacing=0", "spacing=nan",
                            "colour=1", "radius-factor=9", "pixels-per-sample=-1", "=1"})
    EXPECT_EQ(run_relief({"bench", scene, "--sweep", sweep}).exit_code, 2) << sweep;
  EXPECT_EQ(run_relief({"bench", path("x.relief"), "--sweep", "spacing=1"}).exit_code, 2);
  EXPECT_EQ(run_relief({"bench"}).exit_code, 2);
}

TEST_F(BenchCommand, RenderExplainsItself) {
  // Smaller ones would be drawn as proxies.
  const std::string scene = write("square.off", square_off(10));
  const json result = parse(run_relief({"render", scene, "-o", path("square.png"), "--size",
                                        "640x480", "--material", "unlit", "--explain", "--json"}));
  const json& explain = result["explain"];
  EXPECT_EQ(explain["passes"], json({"onepass"}));
  EXPECT_FALSE(explain["draws"].empty());
  for (const json& texture : explain["textures"]) {
    EXPECT_NE(texture["name"], "normal maps");
    EXPECT_NE(texture["name"], "environment");
    EXPECT_EQ(texture["bound"], true) << texture["name"];
  }
  const Outcome text =
      run_relief({"render", scene, "-o", path("square.png"), "--size", "640x480", "--explain"});
  EXPECT_NE(text.out.find("normal maps"), std::string::npos) << text.out;  // lit
  EXPECT_NE(text.out.find("passes: visibility, shading"), std::string::npos) << text.out;
  EXPECT_EQ(
      run_relief({"render", scene, "-o", path("x.png"), "--engine", "ewa", "--explain"}).exit_code,
      2);
}

TEST_F(BenchCommand, RenderTimesPasses) {
  const std::string scene = write("square.off", square_off(10));
  const std::vector<std::string> arguments{"render",      scene,    "-o",
                                           path("a.png"), "--size", "640x480"};
  const auto passes = [&](const std::string& engine) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--engine", engine, "--time-passes", "--frames", "2", "--json"});
    const json result = parse(run_relief(all));
    std::vector<std::string> names;
    for (const json& pass : result["passes"]) {
      EXPECT_GT(pass["ms"], 0.0);
      names.push_back(pass["pass"]);
    }
    return names;
  };
  EXPECT_EQ(passes("onepass"), (std::vector<std::string>{"visibility", "shading"}));
  EXPECT_EQ(passes("surfel"), (std::vector<std::string>{"visibility", "accumulation", "shading"}));
  const Outcome text = run_relief({"render", scene, "-o", path("a.png"), "--time-passes"});
  EXPECT_NE(text.out.find("  passes          visibility "), std::string::npos) << text.out;
  EXPECT_FALSE(
      parse(run_relief({"render", scene, "-o", path("a.png"), "--json"})).contains("passes"));
  EXPECT_EQ(run_relief({"render", scene, "-o", path("x.png"), "--engine", "ewa", "--time-passes"})
                .exit_code,
            2);
}

TEST_F(BenchCommand, ComparesTheEnginesOfVolumes) {
  const std::string volume = write("a.nrrd", small_nrrd());
  const json alone = parse(run_relief(small(volume, {"--transfer", "mr"})));
  EXPECT_EQ(alone["truth"], "volume-truth");
  ASSERT_EQ(alone["rows"].size(), 2U);
  for (const json& row : alone["rows"]) {
    EXPECT_EQ(row["transfer"], "mr");
    EXPECT_TRUE(row["psnr_db"].is_number());
    EXPECT_GE(row["frame_ms"], 0.0);
  }
  // Points without faces: of a mesh, which gets more, so small an image shows proxies, 28 dB from
  // what the truth draws.
  std::string square;
  for (int k = 0; k < 25; ++k) square += fmt::format("{} {} 0\n", k % 5, k / 5);
  (void)write("square.xyz", square);
  const std::string scene = write("scene.json", R"({"models": [{"file": "a.nrrd"},
    {"file": "square.xyz"}], "views": [{"name": "a"}]})");
  const json both = parse(run_relief(small(scene)));
  EXPECT_EQ(both["truth"], "volume-reference");
  EXPECT_TRUE(both["rows"][1]["psnr_db"].is_null()) << "the truth itself";
  EXPECT_GT(both["rows"][0]["psnr_db"], 30.0);
  expect_refused({"bench", volume, "--sweep", "radius-factor=1,2"}, "no --sweep");
  expect_refused({"bench", write("square.off", square_off(5)), "--iso", "3"},
                 "--iso is for volumes and 3D Gaussians");
}

}  // namespace
}  // namespace relief::test

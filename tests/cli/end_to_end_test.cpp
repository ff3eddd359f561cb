// From scans to patch files, through the command alone.
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/json_test.h"
#include "tests/sanitizers/address_sanitizer.h"

namespace relief::test {
namespace {

using nlohmann::json;
using EndToEnd = JsonTest;

TEST_F(EndToEnd, ConvertMeasuresWhatItDid) {
  const std::string scan = write_knot(20000);
  json result = run_json({"convert", scan, "-o", path("knot.relief")});
  expect_keys(result, {"points", "points_dropped", "duplicates_merged", "normals_repaired",
                       "patches", "samples", "spacing", "file_bytes", "seconds", "error_rms",
                       "error_max", "psnr_db", "uncovered_points"});
  EXPECT_GE(result["points"], 20000);
  EXPECT_EQ(result["points_dropped"], 0);
  EXPECT_EQ(result["duplicates_merged"], 0);
  EXPECT_EQ(result["file_bytes"], std::filesystem::file_size(path("knot.relief")));
  EXPECT_EQ(result["uncovered_points"], 0);  // a closed surface without noise
  // 71.5 dB when written; a bump is 0.04 high in a diagonal of 9.7, so that losing the bumps alone
  // would leave 54 dB.
  EXPECT_GT(result["psnr_db"], 65.0);
  // About as many samples as points; the overlap margin of small patches adds a third.
  EXPECT_GT(result["samples"], 18000);
  EXPECT_LT(result["samples"], 34000);
}

TEST_F(EndToEnd, ConvertPrintsASummary) {
  const Outcome run = run_relief({"convert", write_knot(3000), "-o", path("knot.relief")});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");  // no progress bar where there is no terminal
  EXPECT_NE(run.out.find("patches"), std::string::npos) << run.out;
}

TEST_F(EndToEnd, ProgressIsDrawnOnATerminalAndWiped) {
  RunOptions options;
  options.terminal = true;
  const Outcome run = run_relief({"convert", write_knot(3000), "-o", path("knot.relief")}, options);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.err.find("resample"), std::string::npos) << run.err;
  const std::string wipe = "\r\x1b[K";
  ASSERT_GE(run.err.size(), wipe.size());
  EXPECT_EQ(run.err.substr(run.err.size() - wipe.size()), wipe);
}

TEST_F(EndToEnd, InfoReportsTheConvertedFile) {
  const std::string file = path("knot.relief");
  json converted = run_json({"convert", write_knot(5000), "-o", file});
  json info = run_json({"info", file, "--verify"});
  expect_keys(info, {"version", "codec", "patches", "samples", "levels", "spacing", "file_bytes",
                     "bounds_min", "bounds_max", "attributes"});
  for (const char* key : {"patches", "samples", "spacing", "file_bytes"}) {
    EXPECT_EQ(info[key], converted[key]) << key;
  }
  EXPECT_EQ(info["version"], 1);
  EXPECT_EQ(info["attributes"], json({"normal", "colour"}));
  EXPECT_NEAR(info["bounds_max"][0], 3.5, 0.1);  // ring 3 and tube 0.5, plus bumps and sampling
}

TEST_F(EndToEnd, TheFileDoesNotDependOnTheThreads) {
  const std::string scan = write_knot(30000);
  for (const char* codec : {"fast", "compact"}) {
    std::vector<std::string> files;
    for (const char* threads : {"1", "2", "4"}) {
      const std::string file = path(std::string("knot") + threads + ".relief");
      run_json({"convert", scan, "-o", file, "--threads", threads, "--codec", codec});
      files.push_back(file_bytes(file));
    }
    ASSERT_FALSE(files[0].empty());
    EXPECT_EQ(files[0], files[1]) << codec;
    EXPECT_EQ(files[0], files[2]) << codec;
  }
}

TEST_F(EndToEnd, ScansThatFitIntoMemoryAreConvertedInOnePiece) {
  const std::string scan = write_knot(20000);
  run_json({"convert", scan, "-o", path("a.relief")});
  const json limited = run_json({"convert", scan, "-o", path("b.relief"), "--memory", "256M"});
  EXPECT_EQ(limited["tiles"], 1);
  EXPECT_EQ(file_bytes(path("a.relief")), file_bytes(path("b.relief")));
}

TEST_F(EndToEnd, LargerScansAreConvertedInTilesWithinTheMemory) {
  const json result =
      run_json({"convert", write_knot(500000), "-o", path("knot.relief"), "--memory", "256M"});
  EXPECT_GE(result["tiles"], 2);
  EXPECT_EQ(result["tiles_found"], 0);
  EXPECT_GT(result["halo_points"], 0);
  EXPECT_EQ(result["uncovered_points"], 0);
  // AddressSanitizer keeps memory of its own: 0.85 GB.
  if (!kAddressSanitizer) {
    EXPECT_LT(result["peak_bytes"], std::int64_t{256} << 20);
  }
  EXPECT_FALSE(std::filesystem::exists(path("knot.relief.parts")));

  const json info = run_json({"info", path("knot.relief"), "--verify"});
  EXPECT_EQ(info["version"], 3);
  EXPECT_EQ(info["tiles"], result["tiles"]);
  ASSERT_GE(info["overviews"].size(), 2U);  // of half a million samples, down to 65,536
  double spacing = info["spacing"];
  for (const json& level : info["overviews"])
    EXPECT_DOUBLE_EQ(level["spacing"].get<double>(), spacing *= 2.0);
  // From afar the coarsest level alone is read, and the image is that of all patches.
  const std::vector<std::string> render{"render",  path("knot.relief"), "--size",   "400x400",
                                        "--orbit", "30,40,12",          "--frames", "1",
                                        "-o"};
  const auto rendered = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = render;
    arguments.push_back(path(name));
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_relief(arguments);
  };
  const Outcome far = rendered("far.exr", {});
  EXPECT_EQ(far.exit_code, 0) << far.err;
  EXPECT_NE(far.err.find("knot.relief: read "), std::string::npos) << far.err;
  EXPECT_EQ(rendered("all.exr", {"--pixels-per-sample", "0"}).exit_code, 0);
  const json compared = run_json({"compare", path("far.exr"), path("all.exr"), "--flip", "ldr"});
  // Where the silhouettes of three parts of the knot cross, a pixel between them is open in one
  // image and not in the other.
  EXPECT_LE(compared["holes"], 1);
  // 120 pixels across, of normals that differ from pixel to pixel: 35 dB with means of them.
  EXPECT_GT(compared["psnr_db"], 30.0);
}

TEST_F(EndToEnd, CompactFilesHoldTheSameInFewerBytes) {
  const std::string scan = write_knot(30000);
  json fast = run_json({"convert", scan, "-o", path("fast.relief")});
  json compact = run_json({"convert", scan, "-o", path("compact.relief"), "--codec", "compact"});
  json coarse = run_json({"convert", scan, "-o", path("coarse.relief"), "--codec", "compact",
                          "--normal-degrees", "90", "--height-step",
                          std::to_string(fast["spacing"].get<double>() / 10.0)});
  for (const char* key : {"patches", "samples", "spacing", "psnr_db"}) {
    EXPECT_EQ(compact[key], fast[key]) << key;
  }
  EXPECT_LT(compact["height_bytes"], fast["height_bytes"]);
  EXPECT_EQ(compact["colour_bytes"].is_number(), true);
  EXPECT_LT(compact["file_bytes"], 0.8 * fast["file_bytes"].get<double>());
  EXPECT_EQ(coarse["normal_bytes"], 0);
  EXPECT_LT(coarse["height_bytes"], compact["height_bytes"]);
  json info = run_json({"info", path("compact.relief"), "--verify"});
  EXPECT_EQ(info["version"], 2);
  EXPECT_EQ(info["codec"], "compact");
  EXPECT_GT(info["levels"], 3);
  for (const char* key :
       {"samples", "file_bytes", "height_bytes", "normal_bytes", "colour_bytes"}) {
    EXPECT_EQ(info[key], compact[key]) << key;
  }
}

TEST_F(EndToEnd, SeveralScansAreOne) {
  const std::string scan = write_knot(5000);
  json once = run_json({"convert", scan, "-o", path("once.relief")});
  json twice = run_json({"convert", scan, scan, "-o", path("twice.relief")});
  EXPECT_EQ(twice["points"], once["points"]);
  EXPECT_EQ(twice["duplicates_merged"], once["points"]);
  EXPECT_EQ(file_bytes(path("once.relief")), file_bytes(path("twice.relief")));
}

TEST_F(EndToEnd, ScansStandWhereTheirConfSays) {
  // The same scan twice, once moved by 100: its whole width lies between.
  const std::string scan = write_knot(3000);
  const std::string name = std::filesystem::path(scan).filename().string();
  const std::string conf = path("knots.conf");
  std::ofstream(conf) << "bmesh " << name << " 0 0 0 0 0 0 1\nbmesh " << name
                      << " 100 0 0 0 0 0 1\n";
  const json one = run_json({"convert", scan, "-o", path("one.relief")});
  const json two = run_json({"convert", conf, "-o", path("two.relief")});
  EXPECT_EQ(two["points"].get<int>(), 2 * one["points"].get<int>());
  const auto width = [this](const char* file) {
    const json info = run_json({"info", path(file)});
    return info["bounds_max"][0].get<double>() - info["bounds_min"][0].get<double>();
  };
  EXPECT_NEAR(width("two.relief"), width("one.relief") + 100.0, 1e-9);
  std::ofstream(conf) << "bmesh nothing.ply 0 0 0 0 0 0 1\n";
  const Outcome missing = run_relief({"convert", conf, "-o", path("two.relief")});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("nothing.ply"), std::string::npos) << missing.err;
}

TEST_F(EndToEnd, ReportsThePointsThatCleaningAndThinningDrop) {
  const std::string scan = write_knot(5000);
  const std::string far_off = path("far.csv");
  std::ofstream(far_off) << "x,y,z,r,g,b\n9,9,9,1,2,3\n-9,9,9,1,2,255\n";
  const std::vector<std::string> both = {"convert", scan, far_off, "-o", path("a.relief")};
  json plain = run_json(both);
  EXPECT_EQ(plain["outliers_removed"], 0);
  EXPECT_EQ(plain["points_thinned"], 0);
  auto words = both;
  words.insert(words.end(), {"--clean", "--thin", "0.2"});
  json less = run_json(words);
  EXPECT_EQ(less["outliers_removed"], 2);
  EXPECT_GT(less["points_thinned"], 500);
  EXPECT_EQ(plain["stray_points_removed"], 2);
  EXPECT_EQ(less["points"], plain["points"].get<int>() - less["points_thinned"].get<int>());
  const Outcome told = run_relief(words);
  EXPECT_NE(told.out.find("removed           2 outliers, 0 in small clusters"), std::string::npos)
      << told.out;
  words.back() = "0";
  EXPECT_EQ(run_relief(words).exit_code, 2);
}

TEST_F(EndToEnd, InvalidPointsAreCounted) {
  std::string scan;
  for (int i = 0; i < 900; ++i) {
    scan += std::to_string(i % 30) + " " + std::to_string(i / 30) + " 0\n";
  }
  json result = run_json({"convert", write("square.xyz", scan + "nan 1 2\n0 0 0\n1 inf 0\n"), "-o",
                          path("square.relief")});
  EXPECT_EQ(result["points"], 900);
  EXPECT_EQ(result["points_dropped"], 2);
  EXPECT_EQ(result["duplicates_merged"], 1);
}

TEST_F(EndToEnd, TheSmallDragon) {
  const std::string scan =
      std::string(RELIEF_SOURCE_DIR) + "/../shared/data/scans/dragon/dragon_vrip_res4.ply.gz";
  if (!std::filesystem::exists(scan))
    GTEST_SKIP() << "needs the Dragon scan, which is not in the repository: " << scan;
  json result = run_json({"convert", scan, "-o", path("dragon.relief")});
  EXPECT_EQ(result["points"], 5205);
  // 0.05 % of the points, with those that were added.
  EXPECT_LE(result["uncovered_points"], 0.0005 * (5205 + result["points_added"].get<double>()));
  json image =
      run_json({"render", path("dragon.relief"), "-o", path("dragon.png"), "--size", "320x256"});
  // The Dragon fills a good part of its bounding sphere's disc, which is 51,000 pixels here.
  EXPECT_GT(image["covered_pixels"], 10000);
  EXPECT_LT(image["covered_pixels"], 40000);
}

}  // namespace
}  // namespace relief::test

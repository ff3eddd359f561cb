// The main job from a scan to an image, through the command alone.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

class EndToEnd : public CliTest {
 protected:
  /// Runs a command that must succeed with JSON on standard output and nothing on standard error.
  json run_json(std::vector<std::string> arguments, const RunOptions& options = {}) {
    arguments.emplace_back("--json");
    const Outcome run = run_relief(arguments, options);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    json parsed = json::parse(run.out, nullptr, false);
    EXPECT_TRUE(parsed.is_object()) << run.out;
    return parsed.is_object() ? parsed : json::object();
  }
};

void expect_keys(const json& object, const std::set<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

/// A flat square of n x n points of one colour, in XY.
std::string square_ply(int n, const std::string& colour) {
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(n * n) +
                    "\nproperty float x\nproperty float y\nproperty float z\n"
                    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (int i = 0; i < n * n; ++i) {
    ply += std::to_string(i % n) + " " + std::to_string(i / n) + " 0 " + colour + "\n";
  }
  return ply;
}

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
      files.push_back(bytes_of(file));
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
  EXPECT_EQ(bytes_of(path("a.relief")), bytes_of(path("b.relief")));
}

TEST_F(EndToEnd, LargerScansAreConvertedInTilesWithinTheMemory) {
  const json result =
      run_json({"convert", write_knot(500000), "-o", path("knot.relief"), "--memory", "256M"});
  EXPECT_GE(result["tiles"], 2);
  EXPECT_EQ(result["tiles_found"], 0);
  EXPECT_GT(result["halo_points"], 0);
  EXPECT_EQ(result["uncovered_points"], 0);
  EXPECT_LT(result["peak_bytes"], std::int64_t{256} << 20);
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
  EXPECT_EQ(bytes_of(path("once.relief")), bytes_of(path("twice.relief")));
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
  EXPECT_EQ(less["points"].get<int>() + less["points_thinned"].get<int>() + 2,
            plain["points"].get<int>());
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
  EXPECT_LE(result["uncovered_points"], 2);  // 0.05 % of the points
  json image =
      run_json({"render", path("dragon.relief"), "-o", path("dragon.png"), "--size", "320x256"});
  // The Dragon fills a good part of its bounding sphere's disc, which is 51,000 pixels here.
  EXPECT_GT(image["covered_pixels"], 10000);
  EXPECT_LT(image["covered_pixels"], 40000);
}

TEST_F(EndToEnd, RenderWritesEveryChannel) {
  json result = run_json(
      {"render", write_knot(5000), "-o", path("knot.exr"), "--size", "160x128", "--frames", "1"});
  expect_keys(result, {"engine", "primitive", "interpolation", "renderer", "width", "height",
                       "frame_ms", "covered_pixels", "fragments"});
  EXPECT_EQ(result["engine"], "onepass");
  EXPECT_TRUE(result.contains("radius_factor") && result["radius_factor"].is_null());
  EXPECT_EQ(result["width"], 160);
  EXPECT_GT(result["covered_pixels"], 3000);
  const auto image = read_image(path("knot.exr"));
  ASSERT_TRUE(image) << image.error().message;
  for (const char* name : {"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Z", "UV.U", "UV.V", "patch"}) {
    EXPECT_NE(image->find(name), nullptr) << name;
  }
}

TEST_F(EndToEnd, EwaSplatsPointsOfAScanAndSamplesOfPatches) {
  const std::string scan = write_knot(20000);
  const std::string model = path("knot.relief");
  run_json({"convert", scan, "-o", model});
  const std::vector<std::string> options{"--size", "160x128", "--frames", "1", "--engine", "ewa"};
  const auto covered = [&](const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", scene, "-o", path("knot.exr")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    json result = run_json(arguments);
    EXPECT_EQ(result["engine"], "ewa");
    EXPECT_EQ(result["renderer"], "CPU");
    EXPECT_TRUE(result["primitive"].is_null() && result["interpolation"].is_null());
    EXPECT_GT(result["fragments"], result["covered_pixels"]);
    EXPECT_EQ(result["level"].is_null(), more.empty() || more[0] != "--time-budget");
    return result["covered_pixels"].get<double>();
  };
  const double points = covered(scan, {});
  EXPECT_GT(points, 3000.0);
  // The same surface, whose silhouette of some 500 pixels the kernels soften by one or two.
  EXPECT_NEAR(covered(model, {}), points, 0.1 * points);
  for (const char* filter : {"source-space", "circular", "unfiltered"})
    EXPECT_NEAR(covered(scan, {"--filter", filter}), points, 0.2 * points) << filter;
  // However little time there is, there is an image; coarser points reach farther.
  EXPECT_GE(covered(scan, {"--time-budget", "0.001"}), 0.9 * points);
}

TEST_F(EndToEnd, MultipassDrawsPatchesWithAnyRadius) {
  const std::string model = path("knot.relief");
  run_json({"convert", write_knot(5000), "-o", model});
  std::set<std::string> images;
  for (const std::string factor : {"1", "2", "3.5"}) {
    json result = run_json({"render", model, "-o", path("knot.png"), "--engine", "multipass",
                            "--radius-factor", factor, "--size", "160x128"});
    EXPECT_EQ(result["engine"], "multipass");
    EXPECT_EQ(result["primitive"], "quad");
    EXPECT_TRUE(result["interpolation"].is_null());
    EXPECT_EQ(result["radius_factor"], std::stod(factor));
    EXPECT_GT(result["covered_pixels"], 3000);
    images.insert(bytes_of(path("knot.png")));
  }
  EXPECT_EQ(images.size(), 3U);
}

TEST_F(EndToEnd, RaysMeetAMeshsOwnTriangles) {
  // An octahedron about (10, 0, 0) whose corners are 2 from its middle.
  const std::string mesh = write("octahedron.obj",
                                 "v 12 0 0\nv 8 0 0\nv 10 2 0\nv 10 -2 0\nv 10 0 2\nv 10 0 -2\n"
                                 "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\n"
                                 "f 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  json traced = run_json({"render", mesh, "-o", path("traced.exr"), "--engine", "raytrace",
                          "--samples", "1", "--size", "200x200", "--orbit", "0,0,10"});
  EXPECT_EQ(traced["engine"], "raytrace");
  for (const char* key : {"primitive", "interpolation", "gpu_ms", "fragments"})
    EXPECT_TRUE(traced.contains(key) && traced[key].is_null()) << key;
  EXPECT_EQ(traced["renderer"].get<std::string>().rfind("Embree", 0), 0U);
  // From 20 units along +Z it is the square |x| + |y| <= 2 at that distance, from middle to
  // corner 2 / 20 * 100 / tan(22.5 degrees) pixels. Half of its border of 137
  // pixels may fall either way.
  const double half = 10.0 / std::tan(std::acos(-1.0) / 8.0);
  EXPECT_NEAR(traced["covered_pixels"].get<double>(), 2.0 * half * half, 69.0);
  const auto image = read_image(path("traced.exr"));
  ASSERT_TRUE(image) << image.error().message;
  const auto& patches = image->find("patch")->values;
  EXPECT_EQ(std::count(patches.begin(), patches.end(), 0.0F), 200 * 200);
  // The ray of the pixel beside the middle leans by 0.05 / half to both sides, and the surface is
  // z = 2 - |x| - |y|: t (1 - 2 * 0.05 / half) = 18.
  const double depth = 18.0 / (1.0 - 2.0 * 0.05 / half);
  EXPECT_NEAR(image->find("Z")->values[100 * 200 + 100], depth, 2e-6);  // a float at 18
}

TEST_F(EndToEnd, RaysMeetThePatchesOfAScanWithoutTriangles) {
  const std::string scan = write("square.ply", square_ply(40, "200 100 50"));
  const std::string model = path("square.relief");
  run_json({"convert", scan, "-o", model});
  json from_scan = run_json({"render", scan, "-o", path("a.exr"), "--engine", "raytrace",
                             "--samples", "2", "--size", "64x48"});
  json from_patches = run_json({"render", model, "-o", path("b.exr"), "--engine", "raytrace",
                                "--samples", "2", "--size", "64x48"});
  EXPECT_GT(from_scan["covered_pixels"], 500);
  EXPECT_EQ(bytes_of(path("a.exr")), bytes_of(path("b.exr")));
  const auto image = read_image(path("a.exr"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_GT(
      *std::max_element(image->find("patch")->values.begin(), image->find("patch")->values.end()),
      0.0F);
}

TEST_F(EndToEnd, SeveralSamplesAPixelGiveRimsPartialCoverage) {
  const std::string model = path("knot.relief");
  run_json({"convert", write_knot(5000), "-o", model});
  for (const char* engine : {"onepass", "multipass"}) {
    const std::string image = path(std::string(engine) + ".png");
    const auto draw = [&](const std::string& to) {
      return run_json({"render", model, "-o", to, "--engine", engine, "--samples", "8", "--size",
                       "64x64", "--material", "unlit", "--background", "none"});
    };
    EXPECT_EQ(draw(image)["samples"], 9);  // three by three
    draw(path("knot.exr"));
    const auto png = read_image(image);
    const auto exr = read_image(path("knot.exr"));
    ASSERT_TRUE(png && exr);
    std::size_t partial = 0;
    for (std::size_t k = 0; k < 64 * 64; ++k) {
      const float alpha = exr->find("A")->values[k];
      partial += alpha > 0.0F && alpha < 1.0F ? 1 : 0;
      // A PNG has 255 steps; an EXR half floats.
      EXPECT_NEAR(png->find("A")->values[k], alpha, 0.5F / 255.0F + 5e-4F);
      EXPECT_NEAR(std::round(9.0F * alpha), 9.0F * alpha, 0.01F);
      // Premultiplied: no light beyond what is covered.
      EXPECT_LE(exr->find("R")->values[k], alpha + 1e-3F);
    }
    EXPECT_GT(partial, 50U);
  }
}

TEST_F(EndToEnd, OutputsChooseTheChannels) {
  run_json({"render", write_knot(5000), "-o", path("knot.exr"), "--size", "64x64", "--outputs",
            "depth"});
  const auto image = read_image(path("knot.exr"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels.size(), 5U);
  EXPECT_NE(image->find("Z"), nullptr);
}

TEST_F(EndToEnd, EveryMaterialAndPrimitiveDraws) {
  const std::string model = path("knot.relief");
  run_json({"convert", write_knot(5000), "-o", model});
  std::set<std::string> images;
  for (const std::string material : {"unlit", "lit", "mirror"}) {
    for (const std::string primitive : {"quad", "sprite", "cell"}) {
      for (const std::string interpolation : {"direct", "corrected"}) {
        const std::string image = path("knot.png");
        json result =
            run_json({"render", model, "-o", image, "--size", "160x128", "--material", material,
                      "--primitive", primitive, "--interpolation", interpolation});
        EXPECT_GT(result["covered_pixels"], 3000) << material << primitive << interpolation;
        images.insert(bytes_of(image));
      }
    }
  }
  // Materials and interpolations differ for certain; primitives may agree to the last bit, and with
  // cells interpolations where no border is seen.
  EXPECT_GE(images.size(), 6U);
}

TEST_F(EndToEnd, UnlitIsTheStoredColourExactly) {
  const std::string scan = write("square.ply", square_ply(40, "200 100 50"));
  run_json({"render", scan, "-o", path("square.png"), "--material", "unlit", "--size", "64x64",
            "--background", "none"});
  const auto image = read_image(path("square.png"));
  ASSERT_TRUE(image) << image.error().message;
  const std::size_t middle = 32U * 64U + 32U;
  const auto value = [&](const char* name, std::size_t at) {
    return srgb8_from_linear(image->find(name)->values[at]);
  };
  EXPECT_EQ(value("R", middle), 200);
  EXPECT_EQ(value("G", middle), 100);
  EXPECT_EQ(value("B", middle), 50);
  ASSERT_NE(image->find("A"), nullptr);
  EXPECT_EQ(image->find("A")->values[middle], 1.0F);
  EXPECT_EQ(image->find("A")->values[0], 0.0F);
}

TEST_F(EndToEnd, BackgroundIsAnSrgbColour) {
  const std::string scan = write("square.ply", square_ply(20, "200 100 50"));
  run_json(
      {"render", scan, "-o", path("square.png"), "--size", "64x64", "--background", "0.2,0.4,1"});
  const auto image = read_image(path("square.png"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(srgb8_from_linear(image->find("R")->values[0]), 51);
  EXPECT_EQ(srgb8_from_linear(image->find("G")->values[0]), 102);
  EXPECT_EQ(srgb8_from_linear(image->find("B")->values[0]), 255);
}

TEST_F(EndToEnd, TheImageDoesNotDependOnLlvmpipesThreads) {
  const std::string model = path("knot.relief");
  run_json({"convert", write_knot(20000), "-o", model});
  std::vector<std::string> images;
  for (const char* threads : {"1", "4"}) {
    const std::string image = path(std::string("knot") + threads + ".exr");
    RunOptions options;
    options.environment = {{"LP_NUM_THREADS", threads}};
    run_json({"render", model, "-o", image, "--size", "320x256", "--orbit", "-20,15"}, options);
    images.push_back(bytes_of(image));
  }
  ASSERT_FALSE(images[0].empty());
  EXPECT_EQ(images[0], images[1]);
}

TEST_F(EndToEnd, EyeTargetAndOrbitAgree) {
  const std::string model = path("square.relief");
  run_json({"convert", write("square.ply", square_ply(41, "90 90 90")), "-o", model});
  // The square's middle is (20, 20, 0), its bounding radius 20 sqrt(2).
  const double distance = 3.0 * 20.0 * std::sqrt(2.0);
  run_json({"render", model, "-o", path("orbit.png"), "--size", "64x64", "--orbit", "0,0,3"});
  run_json({"render", model, "-o", path("eye.png"), "--size", "64x64", "--eye",
            "20,20," + std::to_string(distance), "--target", "20,20,0"});
  const auto orbit = read_image(path("orbit.png"));
  const auto eye = read_image(path("eye.png"));
  ASSERT_TRUE(orbit && eye);
  // std::to_string cuts the distance after six digits: only pixels at a border may differ.
  std::size_t different = 0;
  for (std::size_t i = 0; i < orbit->find("R")->values.size(); ++i) {
    if (orbit->find("R")->values[i] != eye->find("R")->values[i]) ++different;
  }
  EXPECT_LE(different, 8U);
}

}  // namespace
}  // namespace relief::test

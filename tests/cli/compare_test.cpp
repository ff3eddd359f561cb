// relief compare through the command: what it prints, when it fails, what it refuses.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "tests/cli/run_relief.h"
#include "tests/common/compare/images.h"

namespace relief::test {
namespace {

using nlohmann::json;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A square model of 10 x 10 pixels in 20 x 16, with every channel that `relief render` writes.
Image model_image(float green = 0.2F) {
  Image image = test::image_of(20, 16, [green](int x, int y) {
    return x >= 5 && x < 15 && y >= 3 && y < 13 ? glm::vec3(0.5F, green, 0.1F) : glm::vec3(0);
  });
  const auto where_covered = [](float value, float nothing) {
    return [=](int x, int y) { return x >= 5 && x < 15 && y >= 3 && y < 13 ? value : nothing; };
  };
  for (const auto& [name, value] : {std::pair{"A", 1.0F},
                                    {"N.X", 0.0F},
                                    {"N.Y", 0.0F},
                                    {"N.Z", 1.0F},
                                    {"UV.U", 2.5F},
                                    {"UV.V", 1.5F},
                                    {"patch", 3.0F}}) {
    set_channel(image, name, where_covered(value, 0.0F));
  }
  set_channel(image, "Z", where_covered(4.0F, kInfinity));
  return image;
}

class CompareCommand : public CliTest {
 protected:
  std::string write_image(const std::string& name, const Image& image) const {
    const bool png = name.substr(name.size() - 4) == ".png";
    const Status written = png ? write_png(path(name), image) : write_exr(path(name), image);
    EXPECT_TRUE(written);
    return path(name);
  }

  /// Runs a comparison with `--json` and expects this exit code.
  json compare(std::vector<std::string> arguments, int exit_code = 0) {
    arguments.insert(arguments.begin(), "compare");
    arguments.emplace_back("--json");
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    said_ = run.err;
    EXPECT_EQ(run.err.empty(), exit_code == 0) << run.err;
    json parsed = json::parse(run.out, nullptr, false);
    EXPECT_TRUE(parsed.is_object()) << run.out;
    return parsed.is_object() ? parsed : json::object();
  }

  std::string said_;  ///< on standard error, by the last comparison
};

TEST_F(CompareCommand, ReportsEveryKey) {
  const std::string reference = write_image("b.exr", model_image());
  Image image = model_image(0.3F);
  // A hole, a pixel missing at the border and one beyond it.
  for (const char* name : {"A", "Z"}) {
    Channel& channel = *const_cast<Channel*>(image.find(name));
    const float nothing = name[0] == 'Z' ? kInfinity : 0.0F;
    channel.values[8 * 20 + 10] = nothing;
    channel.values[3 * 20 + 5] = nothing;
    channel.values[0] = name[0] == 'Z' ? 4.0F : 1.0F;
  }
  const json result = compare({write_image("a.exr", image), reference});
  EXPECT_EQ(result["holes"], 1);
  EXPECT_EQ(result["border_missing"], 1);
  EXPECT_EQ(result["border_extra"], 1);
  EXPECT_EQ(result["pixels"], 320);
  EXPECT_EQ(result["covered_reference"], 100);
  EXPECT_EQ(result["covered_both"], 98);
  EXPECT_EQ(result["normal_rms_deg"], 0.0);
  EXPECT_EQ(result["normal_p99_deg"], 0.0);
  EXPECT_EQ(result["depth_rms_relative"], 0.0);
  EXPECT_EQ(result["non_finite"], 0);
  EXPECT_EQ(result["identical"], false);
  EXPECT_EQ(result["flip"], "hdr");
  // Green is off in 100 of 320 pixels, one channel of three; halves hold 11 bits.
  const double step = double{srgb_from_linear(0.3F)} - double{srgb_from_linear(0.2F)};
  EXPECT_NEAR(result["psnr_db"], -20.0 * std::log10(step * std::sqrt(100.0 / 960.0)), 0.02);
  EXPECT_GT(result["flip_mean"], 0.01);
  EXPECT_LT(result["flip_mean"], 1.0);
}

TEST_F(CompareCommand, EqualImagesHaveNoPsnr) {
  const std::string exr = write_image("a.exr", model_image());
  const json result =
      compare({exr, exr, "--fail-below", "psnr_db=100", "--fail-above", "flip_mean=0"});
  EXPECT_TRUE(result["psnr_db"].is_null());
  EXPECT_TRUE(result.contains("psnr_db"));
  EXPECT_EQ(result["flip_mean"], 0.0);
  EXPECT_EQ(result["identical"], true);
  const Outcome run = run_relief({"compare", exr, exr});
  EXPECT_NE(run.out.find("identical"), std::string::npos) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST_F(CompareCommand, PngAndExrOfOneImageAgree) {
  const std::string exr = write_image("a.exr", model_image());
  const std::string png = write_image("a.png", model_image());
  const json result = compare({png, exr, "--fail-below", "psnr_db=50"});
  EXPECT_EQ(result["flip"], "ldr");
  EXPECT_EQ(result["holes"], 0);  // this PNG has alpha
  EXPECT_TRUE(result["normal_rms_deg"].is_null());
  EXPECT_TRUE(result["depth_rms_relative"].is_null());
  EXPECT_TRUE(result["exposure_start"].is_null());
}

TEST_F(CompareCommand, WithoutAlphaCoverageIsUnknown) {
  const std::string png = write_image("a.png", grey_image(20, 16));
  const json result = compare({png, png});
  for (const char* key : {"holes", "border_missing", "border_extra", "covered_both",
                          "psnr_covered_db", "psnr_alpha_db"}) {
    EXPECT_TRUE(result.contains(key) && result[key].is_null()) << key;
  }
  EXPECT_EQ(result["pixels"], 320);
}

TEST_F(CompareCommand, FlipTakesItsOptions) {
  const std::string a = write_image("a.exr", model_image(0.3F));
  const std::string b = write_image("b.exr", model_image());
  std::set<double> means;
  means.insert(compare({a, b}).value("flip_mean", 0.0));
  means.insert(compare({a, b, "--flip", "ldr"}).value("flip_mean", 0.0));
  const json far = compare({a, b, "--flip", "ldr", "--pixels-per-degree", "20"});
  means.insert(far.value("flip_mean", 0.0));
  EXPECT_EQ(means.size(), 3U);
  EXPECT_EQ(far["pixels_per_degree"], 20.0);
}

TEST_F(CompareCommand, LimitsMakeARegressionTest) {
  const std::string a = write_image("a.exr", model_image(0.3F));
  const std::string b = write_image("b.exr", model_image());
  compare({a, b, "--fail-below", "psnr_db=10", "--fail-above", "holes=0"});
  // The result is printed all the same.
  const json result = compare(
      {a, b, "--fail-below", "psnr_db=90", "--fail-above", "holes=0", "--fail-above", "pixels=319"},
      1);
  EXPECT_EQ(result["holes"], 0);
  EXPECT_NE(said_.find("a.exr against "), std::string::npos) << said_;
  EXPECT_NE(said_.find("psnr_db is "), std::string::npos) << said_;
  EXPECT_NE(said_.find(", below 90"), std::string::npos) << said_;
  EXPECT_NE(said_.find("pixels is 320, above 319"), std::string::npos) << said_;
  EXPECT_EQ(said_.find("holes"), std::string::npos) << said_;
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
  compare({b, b, "--fail-above", "psnr_db=40"}, 1);
  EXPECT_NE(said_.find("psnr_db is infinite, above 40"), std::string::npos) << said_;
}

TEST_F(CompareCommand, ALimitOnAMissingQuantityFails) {
  Image flat = model_image();
  flat.channels.erase(flat.channels.begin() + 4, flat.channels.end());  // R G B A are left
  const std::string a = write_image("a.exr", flat);
  const std::string b = write_image("b.exr", model_image());
  compare({a, b, "--fail-above", "normal_rms_deg=1"}, 1);
  EXPECT_NE(said_.find("normal_rms_deg was not measured (the image under test has no channel "
                       "N.X)"),
            std::string::npos)
      << said_;
  compare({b, a, "--fail-below", "depth_rms_relative=0"}, 1);
  EXPECT_NE(said_.find("the reference has no channel Z"), std::string::npos) << said_;
}

TEST_F(CompareCommand, HeatmapIsAnImageOfTheSize) {
  const std::string a = write_image("a.exr", model_image(0.9F));
  const std::string b = write_image("b.exr", model_image());
  compare({a, b, "--heatmap", path("map.png")});
  const auto map = read_image(path("map.png"));
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->width, 20U);
  EXPECT_EQ(map->height, 16U);
  const auto value = [&](const char* name, std::size_t at) {
    return srgb8_from_linear(map->find(name)->values[at]);
  };
  const std::size_t middle = 8U * 20U + 10U;
  EXPECT_GT(value("R", middle), 100);
  // Also written when a limit fails: that is when one looks at it.
  std::filesystem::remove(path("map.png"));
  compare({a, b, "--heatmap", path("map.png"), "--fail-above", "flip_mean=0"}, 1);
  EXPECT_TRUE(std::filesystem::exists(path("map.png")));
}

TEST_F(CompareCommand, RefusesIncomparableImages) {
  const std::string good = write_image("good.exr", model_image());
  const std::string other = write_image("other.exr", grey_image(16, 20));
  Image depth{20, 16, {}};
  set_channel(depth, "Z", [](int, int) { return 1.0F; });
  const std::string colourless = write_image("depth.exr", depth);
  const std::string bytes = file_bytes(good);
  std::filesystem::create_directory(path("folder"));
  const std::string bad[] = {path("missing.exr"),
                             write("empty.png", ""),
                             write("words.exr", "once upon a time"),
                             write("cut.exr", bytes.substr(0, bytes.size() / 2)),
                             path("folder"),
                             other,
                             colourless};
  for (const std::string& image : bad) {
    const std::string name = std::filesystem::path(image).filename();
    expect_refused({"compare", image, good}, name);
    expect_refused({"compare", good, image}, name);
    expect_refused({"compare", good, image, "--heatmap", path("map.png")}, name);
  }
  expect_refused({"compare", other, good}, "16x20");
  expect_refused({"compare", colourless, colourless}, "no channel R");
}

TEST_F(CompareCommand, RefusesAnUnwritableHeatmap) {
  const std::string good = write_image("good.png", grey_image(8, 8));
  std::filesystem::create_directory(path("folder.png"));
  expect_refused({"compare", good, good, "--heatmap", path("missing/map.png")}, "missing");
  expect_refused({"compare", good, good, "--heatmap", path("folder.png")}, "folder.png");
  expect_refused({"compare", good, good, "--heatmap", good}, "good.png");
  RunOptions options;
  options.largest_file = 16;
  expect_refused({"compare", good, good, "--heatmap", path("map.png")}, "map.png", options);
}

TEST_F(CompareCommand, NanPixelsAreCounted) {
  Image broken = model_image();
  for (Channel& channel : broken.channels) {
    for (std::size_t k = 0; k < 5; ++k) {
      channel.values[k * 21] = k % 2 == 0 ? std::nanf("") : -kInfinity;
    }
  }
  const std::string a = write_image("a.exr", broken);
  const std::string b = write_image("b.exr", model_image());
  const json result = compare({a, b});
  EXPECT_EQ(result["non_finite"], 5);
  EXPECT_EQ(result["non_finite_reference"], 0);
  for (const char* key : {"psnr_db", "flip_mean", "normal_rms_deg", "depth_rms_relative"}) {
    EXPECT_TRUE(result[key].is_number()) << key;
  }
  EXPECT_EQ(run_relief({"compare", a, b}).out.find("nan"), std::string::npos);
}

TEST_F(CompareCommand, TheResultIsTheSameEveryTime) {
  const std::string a = write_image("a.exr", model_image(0.3F));
  const std::string b = write_image("b.exr", model_image());
  const std::string first = compare({a, b, "--heatmap", path("1.png")}).dump();
  EXPECT_EQ(compare({a, b, "--heatmap", path("2.png")}).dump(), first);
  EXPECT_EQ(file_bytes(path("1.png")), file_bytes(path("2.png")));
}

TEST_F(CompareCommand, JudgesImagesThatReliefRendered) {
  const std::string scan = write_knot(5000);
  for (const char* name : {"direct", "corrected"}) {
    const Outcome run =
        run_relief({"render", scan, "-o", path(std::string(name) + ".exr"), "--size", "160x128",
                    "--frames", "1", "--primitive", "quad", "--interpolation", name});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  const json result = compare({path("direct.exr"), path("corrected.exr"), "--fail-above", "holes=0",
                               "--fail-above", "non_finite=0"});
  EXPECT_GT(result["covered_both"], 3000);
  // How far the two are apart is the renderer's tests' to judge.
  EXPECT_GT(result["normal_rms_deg"], 0.0);
  EXPECT_GT(result["depth_rms_relative"], 0.0);
  EXPECT_GT(result["psnr_uv_db"], 0.0);
}

}  // namespace
}  // namespace relief::test

// relief render on volumes and 3D Gaussians: each option, and what is refused.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "tests/cli/json_test.h"
#include "tests/preprocess/gaussians/gaussian_files.h"

namespace relief::test {
namespace {

class VolumeCommand : public JsonTest {
 protected:
  /// A soft ball of values from 0 to 100 in 12 x 12 x 12 nodes, 1 apart from 0 on.
  [[nodiscard]] std::string write_ball() const {
    std::string text =
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 12 12 12\nencoding: ascii\n"
        "spacings: 1 1 1\n\n";
    for (int n = 0; n < 12 * 12 * 12; ++n) {
      const double x = n % 12 - 5.5;
      const double y = n / 12 % 12 - 5.5;
      const double z = n / 144 - 5.5;
      text += fmt::format("{:.3f}\n",
                          std::max(0.0, 100.0 * (1.0 - std::sqrt(x * x + y * y + z * z) / 6.0)));
    }
    return write("ball.nrrd", text);
  }
  [[nodiscard]] std::string write_gaussians() const {
    return write("gaussians.ply", plain_ply(sample_scene(1), "binary_little_endian"));
  }

  /// The ball as 12^3 points in a grid of their own, as PLY, PCD or CSV.
  [[nodiscard]] std::string write_points(const std::string& extension) const {
    std::string text;
    if (extension == "ply") {
      text =
          "ply\nformat ascii 1.0\nelement vertex 1728\nproperty float x\nproperty float y\n"
          "property float z\nproperty float Density\nend_header\n";
    } else if (extension == "pcd") {
      text =
          "VERSION 0.7\nFIELDS x y z density\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
          "WIDTH 1728\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1728\nDATA ascii\n";
    } else {
      text = "x y z density\n";
    }
    for (int n = 0; n < 12 * 12 * 12; ++n) {
      // A little off the nodes, so that they are irregular.
      const double x = n % 12 - 5.5 + 0.3 * std::sin(7.0 * n);
      const double y = n / 12 % 12 - 5.5 + 0.3 * std::sin(11.0 * n);
      const double z = n / 144 - 5.5 + 0.3 * std::sin(13.0 * n);
      text += fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}\n", x, y, z,
                          std::max(0.0, 100.0 * (1.0 - std::sqrt(x * x + y * y + z * z) / 6.0)));
    }
    return write("points." + extension, text);
  }

  /// Renders a small EXR and returns its colour channels, one after the other.
  [[nodiscard]] std::vector<float> pixels_of(const std::string& scene,
                                             const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"render", scene,   "-o",           path("a.exr"),
                                       "--size", "40x32", "--background", "none"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const auto image = read_image(path("a.exr"));
    EXPECT_TRUE(image);
    std::vector<float> all;
    if (!image) return all;
    for (const char* const channel : {"R", "G", "B", "A"}) {
      const Channel* const found = image->find(channel);
      EXPECT_NE(found, nullptr) << channel;
      if (found != nullptr) all.insert(all.end(), found->values.begin(), found->values.end());
    }
    for (const float value : all) EXPECT_TRUE(std::isfinite(value));
    return all;
  }

  /// Expects that a value of an option makes another image than none, and an image at all.
  void expect_changes(const std::string& scene, const std::vector<std::string>& options,
                      const std::vector<std::string>& base = {}) const {
    std::vector<std::string> with = base;
    with.insert(with.end(), options.begin(), options.end());
    const std::vector<float> usual = pixels_of(scene, base);
    const std::vector<float> changed = pixels_of(scene, with);
    std::string words;
    for (const std::string& word : options) words += word + " ";
    EXPECT_NE(usual, changed) << words;
    EXPECT_GT(*std::max_element(changed.begin(), changed.end()), 0.0F) << words;
  }

  /// Expects that a command is wrong: exit code 2, and a line that names what it is about.
  void expect_wrong(const std::string& scene, const std::vector<std::string>& options,
                    const std::string& about) const {
    std::vector<std::string> arguments{"render", scene, "-o", path("wrong.png")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto before = files();
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find(about), std::string::npos) << run.err << "does not name " << about;
    EXPECT_EQ(files(), before) << "a file was made, lost or left";
  }
  /// Expects one sentence and exit code 1.
  void expect_no_image(const std::string& scene, const std::vector<std::string>& options,
                       const std::string& about) const {
    std::vector<std::string> arguments{"render", scene, "-o", path("none.png")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(arguments, about);
  }
};

TEST_F(VolumeCommand, ReportsTheEngineThatDrawsVolumesWhereNoneIsNamed) {
  for (const std::string& scene : {write_ball(), write_gaussians()}) {
    const auto report = run_json({"render", scene, "-o", path("a.png"), "--size", "40x32"});
    EXPECT_EQ(report["engine"], "volume") << report;
    EXPECT_GT(report["covered_pixels"].get<int>(), 20) << report;
  }
}

TEST_F(VolumeCommand, EachOptionOfVolumesChangesTheImage) {
  const std::string ball = write_ball();
  const std::string function = write("f.json", R"({"colour": [[0, 1, 0, 0], [100, 0, 0, 1]],
      "opacity": [[10, 0], [100, 0.9]], "gradient_opacity": [[0, 0.1], [20, 1]]})");
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--filter", "unfiltered"},
                                             {"--filter", "uniform-scaling"},
                                             {"--filter", "dilated"},
                                             {"--visibility", "image-sheet"},
                                             {"--visibility", "sorted"},
                                             {"--cutoff", "9"},
                                             {"--transfer", "mr"},
                                             {"--transfer", function},
                                             {"--iso", "50"},
                                             {"--kernel-sigma", "0.7"},
                                             {"--attenuation", "exponential"},
                                             {"--material", "unlit"},
                                             {"--orthographic", "10"}})
    expect_changes(ball, options);
  expect_changes(ball, {"--iso-opacity", "0.3"}, {"--iso", "50", "--transfer", "none"});
  // Minified: where the default filter is at work.
  for (const std::string filter : {"unfiltered", "uniform-scaling"})
    expect_changes(ball, {"--filter", filter}, {"--zoom", "0.2"});
}

TEST_F(VolumeCommand, DefaultsAreWhatTheyAreCalled) {
  const std::string ball = write_ball();
  const std::vector<float> usual = pixels_of(ball, {});
  EXPECT_EQ(usual, pixels_of(ball, {"--engine", "volume", "--filter", "ewa", "--visibility",
                                    "sheet", "--cutoff", "4", "--transfer", "auto",
                                    "--kernel-sigma", "1", "--attenuation", "linear"}));
  const std::string gaussians = write_gaussians();
  EXPECT_EQ(
      pixels_of(gaussians, {}),
      pixels_of(gaussians, {"--filter", "dilated", "--visibility", "sorted", "--max-alpha", "0.99",
                            "--min-transmittance", "0.0001", "--gaussian-near", "0.2",
                            "--jacobian-clamp", "1.3", "--harmonics", "1", "--blend", "srgb"}));
}

TEST_F(VolumeCommand, EachOptionOfGaussiansChangesTheImage) {
  const std::string scene = write_gaussians();
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--filter", "ewa"},
                                             {"--filter", "uniform-scaling"},
                                             {"--filter", "unfiltered"},
                                             {"--visibility", "image-sheet"},
                                             {"--max-alpha", "0.2"},
                                             {"--min-alpha", "0.1"},
                                             {"--cutoff", "1"},
                                             {"--harmonics", "0"},
                                             {"--blend", "linear"}})
    expect_changes(scene, options);
  expect_changes(scene, {"--min-transmittance", "0.6"});
  // The camera stands some units away; the middle one of the three is left out.
  const std::vector<float> all = pixels_of(scene, {});
  EXPECT_NE(all, pixels_of(scene, {"--gaussian-near", "1000"}));
  // Beside the axis, in a wide image.
  const std::vector<std::string> wide{"--eye", "0,2.4,1.2", "--target", "1,2,-2", "--fov", "60"};
  expect_changes(scene, {"--jacobian-clamp", "0.2"}, wide);
}

TEST_F(VolumeCommand, TheTruthHasItsOwnOptions) {
  const std::string ball = write_ball();
  const std::vector<std::string> truth{"--engine", "volume-truth"};
  expect_changes(ball, {"--truth", "field"}, truth);
  expect_changes(ball, {"--step", "1"}, truth);
  expect_changes(ball, {"--samples", "4"}, truth);
  expect_changes(write_gaussians(), {"--min-alpha", "0.1"}, truth);
}

TEST_F(VolumeCommand, AScenesKeysAreThoseOfTheOptions) {
  (void)write_ball();
  const std::string scene = write("scene.json", R"({"models": [{"file": "ball.nrrd"}],
      "background": "none", "kernel-sigma": 0.7, "transfer": "mr",
      "views": [{"name": "a"}]})");
  const auto run = run_relief({"render", scene, "-o", path("b.exr"), "--size", "40x32"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<float> direct =
      pixels_of(path("ball.nrrd"), {"--kernel-sigma", "0.7", "--transfer", "mr"});
  const auto image = read_image(path("b.exr"));
  ASSERT_TRUE(image);
  EXPECT_TRUE(
      std::ranges::equal(image->find("R")->values, std::span(direct).first(direct.size() / 4)));
}

TEST_F(VolumeCommand, WrongValuesAreWrongUsage) {
  const std::string ball = write_ball();
  expect_wrong(ball, {"--filter", "circular"},
               "--filter: engine volume: expected auto, ewa, uniform-scaling");
  expect_wrong(ball, {"--visibility", "back"},
               "expected auto, sheet, image-sheet, sorted; found back");
  expect_wrong(ball, {"--attenuation", "cubic"}, "expected linear, exponential; found cubic");
  expect_wrong(ball, {"--blend", "hsv"}, "expected srgb, linear; found hsv");
  expect_wrong(ball, {"--cutoff", "0"}, "expected a number from 0.1 to 20; found 0");
  expect_wrong(ball, {"--kernel-sigma", "5"}, "expected a number from 0.25 to 4; found 5");
  expect_wrong(ball, {"--iso", "nan"}, "expected a number from -1e+30 to 1e+30; found nan");
  expect_wrong(ball, {"--iso-opacity", "1.5"}, "expected a number from 0 to 1; found 1.5");
  expect_wrong(ball, {"--harmonics", "1.5"}, "expected a whole number from 0 to 4; found 1.5");
  expect_wrong(ball, {"--harmonics", "5"}, "expected a whole number from 0 to 4; found 5");
  for (const std::string share : {"--max-alpha", "--min-alpha", "--min-transmittance"})
    expect_wrong(ball, {share, "-0.1"}, "expected a number from 0 to 1; found -0.1");
  expect_wrong(ball, {"--gaussian-near", "-1"}, "expected a number from 0 to 1e+12; found -1");
  expect_wrong(ball, {"--jacobian-clamp", "101"}, "expected a number from 0 to 100; found 101");
  expect_wrong(ball, {"--transfer", ""}, "--transfer");
  expect_wrong(ball, {"--truth", "field"}, "engine volume does not have it");
  expect_wrong(ball, {"--raw", "3x4"}, "--raw");
  expect_wrong(ball, {"--engine", "volume-reference", "--explain"},
               "engine volume-reference has none");
}

TEST_F(VolumeCommand, WhatCanNotBeDrawnIsOneSentence) {
  const std::string ball = write_ball();
  expect_no_image(ball, {"--transfer", "bones"}, "there is no transfer function bones");
  expect_no_image(ball, {"--transfer", path("missing.json")}, "missing.json");
  expect_no_image(ball, {"--transfer", write("bad.json", "{\"colour\": 1}")}, "bad.json: colour");
  expect_no_image(ball, {"--engine", "onepass"}, "which engine onepass can't draw");
  expect_no_image(ball, {"--engine", "volume-truth", "--iso", "50"}, "use --truth field");
  expect_no_image(write("cut.nrrd", file_bytes(ball).substr(0, 400)), {}, "cut.nrrd");
  expect_no_image(write("voxels.bin", "12345"), {"--raw", "3x4x5:u8"}, "voxels.bin");
  expect_no_image(write("short.ply", file_bytes(write_gaussians()).substr(0, 700)), {},
                  "short.ply");
  expect_no_image(
      write("two.json", R"({"models": [{"file": "ball.nrrd"}, {"file": "gaussians.ply"}],
      "views": [{"name": "a"}]})"),
      {"--engine", "volume-truth"}, "draws a single volume or scene of 3D Gaussians");
  expect_no_image(write("wrong.json", R"({"models": [{"file": "ball.nrrd"}], "iso": "high",
      "views": [{"name": "a"}]})"),
                  {}, "wrong.json: iso: expected a number from -1e+30 to 1e+30; found \"high\"");
}

TEST_F(VolumeCommand, ABoxCutsVolumesAndGaussians) {
  const std::string ball = write_ball();
  const std::vector<std::string> half{"--clip", "50%,0%,0%,100%,100%,100%"};
  for (const std::string engine : {"volume", "volume-reference", "volume-truth"}) {
    expect_changes(ball, half, {"--engine", engine});
    expect_changes(write_gaussians(), half, {"--engine", engine});
  }
  expect_changes(ball, half, {"--engine", "volume-truth", "--truth", "field"});
  EXPECT_EQ(pixels_of(ball, half), pixels_of(ball, {"--clip", "5.5,0,0,11,11,11"}))
      << "nodes are 0 to 11, in world coordinates";
  EXPECT_EQ(pixels_of(ball, {}), pixels_of(ball, {"--clip", "0%,0%,0%,100%,100%,100%"}));
  const auto report = run_json(
      {"render", ball, "-o", path("a.png"), "--size", "40x32", "--clip", "5.50,0%,0,11,100%,11"});
  EXPECT_EQ(report["clip"], "5.5,0%,0,11,100%,11") << report;
  for (const std::string box : {"1,2,3", "5,0,0,4,1,1", "0,0,0,120%,1,1", "a,b,c,d,e,f"})
    expect_wrong(ball, {"--clip", box},
                 "expected X0,Y0,Z0,X1,Y1,Z1, each a coordinate or a percentage as in 50%, the "
                 "lower corner first; found " +
                     box);
  expect_no_image(ball, {"--clip", "20,0,0,30,1,1"},
                  "holds nothing of the model, which reaches from 0,0,0 to 11,11,11");
  expect_no_image(write("box.json", R"({"models": [{"file": "ball.nrrd"}], "clip": "1,2",
      "views": [{"name": "a"}]})"),
                  {}, "box.json: clip: expected X0,Y0,Z0,X1,Y1,Z1");
  expect_wrong(ball, {"--clip", "0,0,0,1,1,1", "--engine", "onepass"}, "--clip");
}

TEST_F(VolumeCommand, PointsWithAScalarAreAVolume) {
  const std::vector<std::string> density{"--volume-scalar", "density"};
  const std::vector<float> ball = pixels_of(write_points("ply"), density);
  EXPECT_GT(*std::max_element(ball.begin(), ball.end()), 0.2F);
  for (const std::string extension : {"pcd", "xyz"}) {
    // Upright as points are: a PCD has the stance of its sensor.
    const std::vector<float> same =
        pixels_of(write_points(extension), {"--volume-scalar", "Density", "--up", "z"});
    if (extension == "xyz") {
      EXPECT_EQ(ball, same);
    }
    EXPECT_GT(*std::max_element(same.begin(), same.end()), 0.2F);
  }
  const std::string points = path("points.ply");
  expect_changes(points, {"--iso", "50"}, density);
  expect_changes(points, {"--clip", "0,0%,0%,100%,100%,100%"}, density);
  expect_changes(points, {"--visibility", "image-sheet"}, density);
  expect_changes(points, {"--kernel-sigma", "0.6"}, density);
  expect_changes(points, {"--crop", "-6,-6,0,6"}, density);
  const std::vector<float> drawn =
      pixels_of(points, {"--volume-scalar", "density", "--engine", "volume"});
  double sum = 0.0;
  for (std::size_t k = 0; k < drawn.size(); ++k)
    sum += std::pow(static_cast<double>(drawn[k] - ball[k]), 2.0);
  EXPECT_LT(sum / static_cast<double>(drawn.size()), 1e-8);
}

TEST_F(VolumeCommand, PointsThatAreNoVolumeAreOneSentence) {
  const std::string points = write_points("ply");
  const std::vector<std::string> density{"--volume-scalar", "density"};
  expect_no_image(points, {"--volume-scalar", "heat"}, "has no scalar 'heat'; it has density");
  expect_no_image(write("three.xyz", "x y z density\n0 0 0 1\n1 0 0 2\n0 1 0 3\n"), density,
                  "three.xyz: the scan has 3 distinct points");
  expect_no_image(write_ball(), density, "ball.nrrd: has no points whose scalar 'density'");
  expect_no_image(write_gaussians(), density, "has no points whose scalar");
  expect_no_image(write("a.relief", "RELIEF"), density, "has no points whose scalar");
  expect_no_image(points, {"--volume-scalar", "density", "--engine", "onepass"},
                  "which engine onepass can't draw");
  expect_no_image(points, {"--volume-scalar", "density", "--engine", "volume-truth"},
                  "regular grid only");
  expect_no_image(write("none.xyz", "x y z density\n0 0 0 nan\n1 0 0 nan\n"), density,
                  "has no finite number");
  expect_wrong(points, {"--volume-scalar", ""}, "expected the name of a scalar");
  expect_wrong(points, {"--volume-scalar", "density", "--raw", "3x4x5:u8"}, "--raw");
}

TEST_F(VolumeCommand, EnginesAgree) {
  for (const std::string& scene : {write_ball(), write_gaussians()}) {
    const std::vector<float> reference = pixels_of(scene, {});
    const std::vector<float> drawn = pixels_of(scene, {"--engine", "volume"});
    ASSERT_EQ(reference.size(), drawn.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < drawn.size(); ++k)
      sum += std::pow(static_cast<double>(drawn[k] - reference[k]), 2.0);
    // 50 dB, as tests/renderer/engines/volume has it for coarse grids.
    EXPECT_LT(sum / static_cast<double>(drawn.size()), 1e-5) << scene;
  }
}

TEST_F(VolumeCommand, TheEngineOnOpenGlExplainsItself) {
  const auto with = [&](const std::string& scene, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "render",   scene,    "-o",        path("a.png"), "--size", "40x32",
        "--engine", "volume", "--explain", "--orbit",     "20,15,4"};  // nearer eyes take lists
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_json(arguments)["explain"];
  };
  const auto passes = [](const nlohmann::json& explanation) {
    return explanation["passes"].get<std::vector<std::string>>();
  };
  const std::string ball = write_ball();
  const auto by_shaders = [&](const std::string& scene, std::vector<std::string> more) {
    more.insert(more.end(), {"--drawn-by", "shaders"});
    return passes(with(scene, more));
  };
  EXPECT_EQ(by_shaders(ball, {}), (std::vector<std::string>{"volume nodes", "volume sheets"}));
  EXPECT_EQ(by_shaders(ball, {"--iso", "50"}), std::vector<std::string>{"volume lists"});
  EXPECT_EQ(by_shaders(write_gaussians(), {}), std::vector<std::string>{"volume quads"});
  EXPECT_EQ(passes(with(ball, {"--drawn-by", "cpu"})),
            std::vector<std::string>{"volume on the CPU"});
}

}  // namespace
}  // namespace relief::test

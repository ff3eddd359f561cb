// From scans and patch files to images, through the command alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;
using RenderEndToEnd = JsonTest;

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

TEST_F(RenderEndToEnd, RenderWritesEveryChannel) {
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

TEST_F(RenderEndToEnd, EwaSplatsPointsOfAScanAndSamplesOfPatches) {
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

TEST_F(RenderEndToEnd, MultipassDrawsPatchesWithAnyRadius) {
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
    images.insert(file_bytes(path("knot.png")));
  }
  EXPECT_EQ(images.size(), 3U);
}

TEST_F(RenderEndToEnd, RaysMeetAMeshsOwnTriangles) {
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

TEST_F(RenderEndToEnd, RaysMeetThePatchesOfAScanWithoutTriangles) {
  const std::string scan = write("square.ply", square_ply(40, "200 100 50"));
  const std::string model = path("square.relief");
  run_json({"convert", scan, "-o", model});
  json from_scan = run_json({"render", scan, "-o", path("a.exr"), "--engine", "raytrace",
                             "--samples", "2", "--size", "64x48"});
  json from_patches = run_json({"render", model, "-o", path("b.exr"), "--engine", "raytrace",
                                "--samples", "2", "--size", "64x48"});
  EXPECT_GT(from_scan["covered_pixels"], 500);
  EXPECT_EQ(file_bytes(path("a.exr")), file_bytes(path("b.exr")));
  const auto image = read_image(path("a.exr"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_GT(
      *std::max_element(image->find("patch")->values.begin(), image->find("patch")->values.end()),
      0.0F);
}

TEST_F(RenderEndToEnd, SeveralSamplesAPixelGiveRimsPartialCoverage) {
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

TEST_F(RenderEndToEnd, OutputsChooseTheChannels) {
  run_json({"render", write_knot(5000), "-o", path("knot.exr"), "--size", "64x64", "--outputs",
            "depth"});
  const auto image = read_image(path("knot.exr"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->channels.size(), 5U);
  EXPECT_NE(image->find("Z"), nullptr);
}

TEST_F(RenderEndToEnd, EveryMaterialAndPrimitiveDraws) {
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
        images.insert(file_bytes(image));
      }
    }
  }
  // Materials and interpolations differ for certain; primitives may agree to the last bit, and with
  // cells interpolations where no border is seen.
  EXPECT_GE(images.size(), 6U);
}

TEST_F(RenderEndToEnd, UnlitIsTheStoredColourExactly) {
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

TEST_F(RenderEndToEnd, BackgroundIsAnSrgbColour) {
  const std::string scan = write("square.ply", square_ply(20, "200 100 50"));
  run_json(
      {"render", scan, "-o", path("square.png"), "--size", "64x64", "--background", "0.2,0.4,1"});
  const auto image = read_image(path("square.png"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(srgb8_from_linear(image->find("R")->values[0]), 51);
  EXPECT_EQ(srgb8_from_linear(image->find("G")->values[0]), 102);
  EXPECT_EQ(srgb8_from_linear(image->find("B")->values[0]), 255);
}

TEST_F(RenderEndToEnd, TheImageDoesNotDependOnLlvmpipesThreads) {
  const std::string model = path("knot.relief");
  run_json({"convert", write_knot(20000), "-o", model});
  std::vector<std::string> images;
  for (const char* threads : {"1", "4"}) {
    const std::string image = path(std::string("knot") + threads + ".exr");
    RunOptions options;
    options.environment = {{"LP_NUM_THREADS", threads}};
    run_json({"render", model, "-o", image, "--size", "320x256", "--orbit", "-20,15"}, options);
    images.push_back(file_bytes(image));
  }
  ASSERT_FALSE(images[0].empty());
  EXPECT_EQ(images[0], images[1]);
}

/// A square of 2 n^2 triangles, red.
std::string square_mesh(int n) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float "
      "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face {}\nproperty "
      "list uchar int vertex_indices\nend_header\n",
      (n + 1) * (n + 1), 2 * n * n);
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) text += fmt::format("{} {} 0 200 40 40\n", x, y);
  }
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int at = y * (n + 1) + x;
      text += fmt::format("3 {} {} {}\n3 {} {} {}\n", at, at + 1, at + n + 1, at + 1, at + n + 2,
                          at + n + 1);
    }
  }
  return text;
}

TEST_F(RenderEndToEnd, PointsShowTheirColoursAndMeshesAreLit) {
  const auto material_of = [this](const std::string& scan) {
    return run_json({"render", scan, "-o", path("look.png"), "--size", "64x64"})["material"];
  };
  EXPECT_EQ(material_of(write("points.ply", square_ply(21, "200 40 40"))), "unlit");
  const std::string faces = write("faces.ply", square_mesh(20));
  EXPECT_EQ(material_of(faces), "lit");
  run_json({"convert", faces, "-o", path("faces.relief")});
  EXPECT_EQ(material_of(path("faces.relief")), "lit") << "as the scan that it was";
}

TEST_F(RenderEndToEnd, EyeTargetAndOrbitAgree) {
  const std::string model = path("square.relief");
  run_json({"convert", write("square.ply", square_ply(41, "90 90 90")), "-o", model});
  // The square's middle is (20, 20, 0), its bounding radius 20 sqrt(2).
  const double distance = 3.0 * 20.0 * std::sqrt(2.0);
  run_json({"render", model, "-o", path("orbit.png"), "--size", "64x64", "--orbit", "0,0,3", "--up",
            "y"});
  run_json({"render", model, "-o", path("eye.png"), "--size", "64x64", "--eye",
            "20,20," + std::to_string(distance), "--target", "20,20,0", "--up", "y"});
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

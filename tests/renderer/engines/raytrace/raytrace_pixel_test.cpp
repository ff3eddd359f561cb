// From rays to pixels: samples, opacity, order, and what is not there.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <set>

#include "renderer/engines/raytrace/sampling.h"
#include "tests/renderer/meshes.h"

namespace relief {
namespace {

using raytrace::sample_pattern;
using test::add_sheet;
using test::must_trace;
using test::values;

/// Straight down onto the plane z = 0: an image of `side` pixels, each 1 x 1.
RenderSettings straight_down(std::uint32_t side) {
  const double half = 0.5 * side;
  return test::traced_image({{0.0, 0.0, half}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 90.0}, side, side);
}

TEST(SamplePattern, OneIsThePixelsMiddle) {
  EXPECT_EQ(sample_pattern(1), std::vector<glm::dvec2>{glm::dvec2(0.5)});
}

TEST(SamplePattern, EveryRowAndColumnHasOne) {
  for (const int samples : {2, 4, 16, 64, 1024}) {
    std::set<int> columns;
    std::set<int> rows;
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& offset : sample_pattern(samples)) {
      columns.insert(static_cast<int>(std::floor(offset.x * samples)));
      rows.insert(static_cast<int>(std::floor(offset.y * samples)));
      sum += offset;
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(samples));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(samples));
    EXPECT_EQ(*rows.begin(), 0);
    EXPECT_EQ(*rows.rbegin(), samples - 1);
    EXPECT_NEAR(sum.x / samples, 0.5, 1e-12);
    EXPECT_NEAR(sum.y / samples, 0.5, 1e-12);
  }
}

/// The area of the pixel at (x, y), lower left corner, in the half plane dot(n, p) < offset; by a
/// sum over strips, exact along x.
double area_below(glm::dvec2 corner, glm::dvec2 n, double offset) {
  constexpr int kStrips = 1000;
  double sum = 0.0;
  for (int i = 0; i < kStrips; ++i) {
    const double y = corner.y + (i + 0.5) / kStrips;
    sum += std::clamp((offset - n.y * y) / n.x - corner.x, 0.0, 1.0);
  }
  return sum / kStrips;
}

TEST(PixelSamples, CoverageOfAHalfPlaneIsItsAreaInThePixel) {
  // Everything left of a slanted line through the image, 16 pixels wide.
  const glm::dvec2 n = glm::normalize(glm::dvec2(1.0, 0.37));
  constexpr double kOffset = 0.21;
  const glm::dvec2 along(-n.y, n.x);
  TriangleMesh mesh;
  add_sheet(mesh, glm::dvec3(kOffset * n - 50.0 * n - 50.0 * along, 0.0), glm::dvec3(50.0 * n, 0.0),
            glm::dvec3(100.0 * along, 0.0), {0.8F, 0.4F, 0.2F, 1.0F});
  RenderSettings settings = straight_down(16);
  settings.material = Material::Unlit;
  // The largest errors over 1,500 random half planes, by a program of its own.
  const std::vector<std::pair<int, double>> patterns{
      {1, 0.5}, {4, 0.29}, {64, 0.052}, {1024, 0.008}};
  for (const auto& [samples, largest_error] : patterns) {
    settings.raytrace.samples = samples;
    const RenderResult result = must_trace(mesh, settings);
    std::size_t between = 0;
    double worst = 0.0;
    for (std::size_t k = 0; k < 256; ++k) {
      const std::size_t row = k / 16;
      const glm::dvec2 corner(static_cast<double>(k % 16) - 8.0, 7.0 - static_cast<double>(row));
      double share = 0.0;
      for (const glm::dvec2& offset : sample_pattern(samples))
        share += glm::dot(n, corner + offset) < kOffset ? 1.0 / samples : 0.0;
      const float alpha = values(result.image, "A")[k];
      EXPECT_NEAR(alpha, share, 1e-6) << samples;
      EXPECT_NEAR(values(result.image, "R")[k], 0.8F * alpha, 1e-6);
      worst = std::max(worst, std::abs(alpha - area_below(corner, n, kOffset)));
      between += alpha > 0.0F && alpha < 1.0F ? 1 : 0;
      // Geometry is the middle's, whatever the coverage.
      const bool middle = glm::dot(n, corner + 0.5) < kOffset;
      EXPECT_EQ(std::isfinite(values(result.image, "Z")[k]), middle);
      EXPECT_EQ(values(result.image, "N.Z")[k], middle ? 1.0F : 0.0F);
    }
    EXPECT_EQ(between > 0, samples > 1);
    EXPECT_LE(worst, largest_error);
  }
}

TEST(Opacity, SheetsBlendFrontToBackWhateverTheirOrderInTheMesh) {
  struct Sheet {
    double z;
    glm::vec4 colour;
  };
  const std::vector<Sheet> sheets{{2.0, {1.0F, 0.0F, 0.0F, 0.25F}},
                                  {1.0, {0.0F, 1.0F, 0.0F, 0.5F}},
                                  {0.0, {0.0F, 0.0F, 1.0F, 0.75F}}};
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
    TriangleMesh mesh;
    for (const std::size_t s : order) {
      add_sheet(mesh, {-30.0, -30.0, sheets[s].z}, {60.0, 0.0, 0.0}, {0.0, 60.0, 0.0},
                sheets[s].colour);
    }
    RenderSettings settings = straight_down(16);
    settings.material = Material::Unlit;
    const RenderResult result = must_trace(mesh, settings);
    // Also in the pixels of the diagonal, which pass through the edge that two triangles share.
    for (std::size_t k = 0; k < 256; ++k) {
      EXPECT_NEAR(values(result.image, "R")[k], 0.25, 1e-6) << k;
      EXPECT_NEAR(values(result.image, "G")[k], 0.75 * 0.5, 1e-6) << k;
      EXPECT_NEAR(values(result.image, "B")[k], 0.75 * 0.5 * 0.75, 1e-6) << k;
      EXPECT_NEAR(values(result.image, "A")[k], 1.0 - 0.75 * 0.5 * 0.25, 1e-6) << k;
      EXPECT_NEAR(values(result.image, "Z")[k], 8.0 - 2.0, 1e-6);
    }
  }
}

TEST(Opacity, WhereSheetsCrossTheirOrderChanges) {
  // Two sheets that meet in the image's middle column line, as in Figure 7 of [Zwicker 2001].
  TriangleMesh mesh;
  const glm::vec4 red(1.0F, 0.0F, 0.0F, 0.5F);
  const glm::vec4 blue(0.0F, 0.0F, 1.0F, 0.5F);
  add_sheet(mesh, {-30.0, -30.0, -3.0}, {60.0, 0.0, 6.0}, {0.0, 60.0, 0.0}, red);
  add_sheet(mesh, {-30.0, -30.0, 3.0}, {60.0, 0.0, -6.0}, {0.0, 60.0, 0.0}, blue);
  RenderSettings settings = straight_down(16);
  settings.material = Material::Unlit;
  const RenderResult result = must_trace(mesh, settings);
  for (std::size_t k = 0; k < 256; ++k) {
    const bool red_in_front = k % 16 >= 8;
    EXPECT_NEAR(values(result.image, "R")[k], red_in_front ? 0.5 : 0.25, 1e-6) << k;
    EXPECT_NEAR(values(result.image, "B")[k], red_in_front ? 0.25 : 0.5, 1e-6) << k;
    EXPECT_NEAR(values(result.image, "A")[k], 0.75, 1e-6) << k;
  }
}

TEST(Background, LiesBehindWhatIsNotCovered) {
  TriangleMesh mesh;
  add_sheet(mesh, {-30.0, -30.0, 0.0}, {60.0, 0.0, 0.0}, {0.0, 60.0, 0.0},
            {1.0F, 0.5F, 0.0F, 0.25F});
  RenderSettings settings = straight_down(8);
  settings.material = Material::Unlit;
  settings.background = glm::vec3(0.2F, 0.4F, 0.8F);
  const RenderResult result = must_trace(mesh, settings);
  EXPECT_NEAR(values(result.image, "R")[9], 0.25 * 1.0 + 0.75 * 0.2, 1e-6);
  EXPECT_NEAR(values(result.image, "G")[9], 0.25 * 0.5 + 0.75 * 0.4, 1e-6);
  EXPECT_NEAR(values(result.image, "B")[9], 0.75 * 0.8, 1e-6);
  EXPECT_EQ(values(result.image, "A")[9], 1.0F);
  EXPECT_EQ(result.covered_pixels, 64U);
}

/// Two spheres in one place, a red and a blue one, whose triangles come in random order.
TriangleMesh two_traced_spheres() {
  TriangleMesh mesh = test::sphere_mesh(60);
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t k = 0; k < vertices; ++k) {
    mesh.positions.push_back(mesh.positions[k]);
    mesh.normals.push_back(mesh.normals[k]);
  }
  for (const Triangle& t : std::vector<Triangle>(mesh.triangles))
    mesh.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
  mesh.colours.assign(vertices, glm::vec4(1, 0, 0, 1));
  mesh.colours.resize(std::size_t{2} * vertices, glm::vec4(0, 0, 1, 1));
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937(4));
  return mesh;
}

RenderSettings sphere_image() {
  return test::traced_image(orbit_camera({}, 1.0, {10.0, 20.0}, 45.0, 1.2), 128, 128);
}

TEST(Ties, OfCoincidentTrianglesTheFirstIsVisible) {
  TriangleMesh mesh = two_traced_spheres();
  RenderSettings settings = sphere_image();
  settings.material = Material::Unlit;
  const RenderResult all = must_trace(mesh, settings);
  std::set<Triangle> distinct;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size() / 2);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return !distinct.insert({t[0] % vertices, t[1] % vertices, t[2] % vertices}).second;
  });
  const RenderResult first = must_trace(mesh, settings);
  EXPECT_GT(all.covered_pixels, 4000U);
  EXPECT_EQ(values(all.image, "R"), values(first.image, "R"));
  EXPECT_EQ(values(all.image, "B"), values(first.image, "B"));
}

TEST(Threads, DoNotChangeTheImage) {
  TriangleMesh mesh = two_traced_spheres();
  RenderSettings settings = sphere_image();
  settings.raytrace.samples = 4;
  const auto render_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return must_trace(mesh, settings);
  };
  for (const bool transparent : {false, true}) {
    if (transparent) mesh.colours[0].a = 0.5F;
    const RenderResult one = render_with(1);
    for (const std::size_t threads : {2U, 4U}) {
      const RenderResult more = render_with(threads);
      for (const Channel& channel : one.image.channels)
        EXPECT_EQ(channel.values, values(more.image, channel.name.c_str())) << channel.name;
    }
  }
}

/// Counts, and asks to stop once it has been told of `patience` units.
class Counting final : public Progress {
 public:
  explicit Counting(std::uint64_t patience) : patience_(patience) {}
  void begin_stage(std::string_view /*name*/, std::uint64_t units) override {
    units_ = units;
    done_ = 0;
  }
  void advance(std::uint64_t units) override { done_ += units; }
  [[nodiscard]] bool cancelled() const override { return done_ >= patience_; }
  [[nodiscard]] std::uint64_t units() const { return units_; }
  [[nodiscard]] std::uint64_t done() const { return done_; }

 private:
  std::uint64_t patience_;
  std::uint64_t units_ = 0;
  std::atomic<std::uint64_t> done_{0};
};

TEST(Tracing, ReportsProgressAndCanBeCancelled) {
  const TriangleMesh mesh = test::sphere_mesh(24);
  RenderSettings settings = test::traced_image({{0, 0, 3}, {}, {0, 1, 0}, 45.0}, 100, 90);
  settings.frames = 2;
  Counting patient(1000);
  ASSERT_TRUE(render(mesh, settings, patient));
  EXPECT_EQ(patient.units(), 2U * 7U * 6U);  // tiles of 16 pixels
  EXPECT_EQ(patient.done(), patient.units());
  Counting hasty(5);
  const auto stopped = render(mesh, settings, hasty);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().message, interrupted_error().message);
  EXPECT_LT(hasty.done(), hasty.units());
}

TEST(Tracing, ReportsOnlyWhatItMeasures) {
  const RenderResult result = must_trace(test::sphere_mesh(8), straight_down(8));
  EXPECT_EQ(result.renderer.rfind("Embree ", 0), 0U);
  EXPECT_GT(result.frame_ms, 0.0);
  EXPECT_FALSE(result.gpu_ms);
  EXPECT_FALSE(result.fragments);
}

}  // namespace
}  // namespace relief

#include "preprocess/convert.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>

#include "common/octahedral.h"
#include "tests/preprocess/shuffled.h"
#include "tests/preprocess/surfaces.h"

namespace relief {
namespace {

ConvertResult must_convert(const Points& points, const ConvertOptions& options = {}) {
  Progress progress;
  Result<ConvertResult> result = convert(points, options, progress);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(*result);
}

bool same_model(const PatchModel& a, const PatchModel& b) {
  if (a.patches.size() != b.patches.size()) return false;
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    const Patch& x = a.patches[p];
    const Patch& y = b.patches[p];
    if (x.origin != y.origin || x.axes != y.axes || x.spacing != y.spacing ||
        x.heights != y.heights || x.normals.texels != y.normals.texels ||
        x.colours.texels != y.colours.texels) {
      return false;
    }
  }
  return true;
}

TEST(Convert, CoversATorus) {
  const ConvertResult result = must_convert(test::sample_torus({}, 0.02));
  EXPECT_EQ(result.report.uncovered_points, 0U);
  // The diagonal is 4 and the points are exact: heights rounded to a twentieth of 0.02 alone give
  // 20 log10(4 sqrt(12) / 0.001) = 83 dB; chords of the bilinear cells cost some of that.
  EXPECT_GT(result.report.psnr_db, 80.0);
  EXPECT_LE(result.model.patches.size(), 20U);
  EXPECT_NEAR(result.model.bounding_radius, 1.4, 0.01);
}

TEST(Convert, GivesTheSameWhateverTheNumberOfThreads) {
  Points points = test::sample_torus({}, 0.03);
  for (const glm::dvec3& p : points.positions) {
    points.colours.emplace_back(127.0 + 80.0 * p.x, 127.0 + 80.0 * p.y, 127.0 + 200.0 * p.z);
  }
  ConvertOptions options;
  options.threads = 1;
  const ConvertResult one = must_convert(points, options);
  for (const int threads : {2, 4}) {
    options.threads = threads;
    const ConvertResult other = must_convert(points, options);
    EXPECT_TRUE(same_model(one.model, other.model)) << threads;
    EXPECT_EQ(one.report.error_rms, other.report.error_rms) << threads;
  }
}

TEST(Convert, WorksFarFromTheOrigin) {
  const glm::dvec3 far_away(515368.6, 4918340.4, 2322.9);  // UTM
  Points points = test::sample_torus({}, 0.03);
  const ConvertResult near = must_convert(points);
  for (glm::dvec3& p : points.positions) p += far_away;
  const ConvertResult far = must_convert(points);
  EXPECT_EQ(far.report.uncovered_points, 0U);
  // Doubles at 5e6 keep 1e-9: invisible beside spacing / 20.
  EXPECT_NEAR(far.report.psnr_db, near.report.psnr_db, 0.2);
}

TEST(Convert, DropsOutliersInsteadOfMakingPatchesOfThem) {
  Points points = test::sample_sphere(8000);
  const std::size_t clean = points.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  while (points.size() < clean + 40) {
    const glm::dvec3 p(anywhere(random), anywhere(random), anywhere(random));
    if (glm::length(p) > 1.2) points.positions.push_back(p);
  }
  const ConvertResult result = must_convert(points);
  EXPECT_LE(result.model.patches.size(), 12U);
  EXPECT_EQ(result.report.stray_points + result.report.uncovered_points, 40U);
  EXPECT_GE(result.report.stray_points, 30U);
  EXPECT_EQ(result.report.points + result.report.stray_points, points.size());
}

/// The largest angle of a patch's normals to those of the unit sphere below, degrees.
double largest_turn(const PatchModel& model) {
  double least = 1.0;
  for (const Patch& patch : model.patches) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        const glm::dvec3 normal =
            patch.axes * glm::dvec3(unit_from_snorm16(patch.normals.texels[j * patch.width + i]));
        least = std::min(least, glm::dot(normal, glm::normalize(position_of(patch, i, j))));
      }
    }
  }
  return glm::degrees(std::acos(least));
}

// With noise of half a spacing in them, normals turned by up to 90 degrees and many patches were
// needed.
TEST(Convert, MakesOfANoisySphereWhatItMakesOfACleanOne) {
  Points points = test::sample_sphere(8000);
  const ConvertResult clean = must_convert(points);
  std::mt19937 random(3);
  const double spacing = std::sqrt(4.0 * std::numbers::pi / 8000.0);
  std::normal_distribution<double> noise(0.0, 0.5 * spacing);
  for (glm::dvec3& p : points.positions)
    p += glm::dvec3(noise(random), noise(random), noise(random));
  const ConvertResult result = must_convert(points);
  EXPECT_NEAR(result.report.noise, 0.5 * spacing, 0.06 * spacing);
  EXPECT_EQ(result.report.points_moved, points.size());
  EXPECT_LE(result.model.patches.size(), clean.model.patches.size() + 2);
  EXPECT_LT(largest_turn(result.model), 10.0);
  // The error is that of the points as scanned: the noise.
  EXPECT_NEAR(result.report.error_rms, 0.5 * spacing, 0.06 * spacing);

  ConvertOptions keep;
  keep.noise_removal = NoiseRemoval::None;
  const ConvertResult kept = must_convert(points, keep);
  EXPECT_EQ(kept.report.points_moved, 0U);
  EXPECT_GT(largest_turn(kept.model), 45.0);
}

/// A sphere scanned in `rings` rings whose points are 10 times as dense as the rings. `noise` is
/// along the rays, in distances of rings.
Points sphere_of_rings(int rings, double noise) {
  std::mt19937 random(3);
  const double apart = std::numbers::pi / rings;
  std::normal_distribution<double> along(0.0, 1.0);
  Points points;
  for (int ring = 0; ring < rings; ++ring) {
    const double polar = (ring + 0.5) * apart;
    const int count = static_cast<int>(20.0 * rings * std::sin(polar));
    for (int i = 0; i < count; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / count;
      points.positions.push_back((1.0 + noise * apart * along(random)) *
                                 glm::dvec3(std::sin(polar) * std::cos(turn),
                                            std::sin(polar) * std::sin(turn), std::cos(polar)));
    }
  }
  return points;
}

// Each ring became a patch of its own, whose normals were off by up to 180 degrees.
TEST(Convert, MakesASurfaceOfScanLinesFarApart) {
  for (const double noise : {0.0, 0.02, 0.3}) {
    Points points = sphere_of_rings(40, noise);
    const std::size_t scanned = points.size();
    const ConvertResult result = must_convert(points);
    EXPECT_EQ(result.report.points + result.report.points_merged + result.report.stray_points,
              scanned);
    EXPECT_LE(result.model.patches.size(), 12U) << noise;
    EXPECT_LT(largest_turn(result.model), noise > 0.1 ? 15.0 : 5.0) << noise;
  }
}

/// A torus of quads that are halved, with radii 1 and 0.3.
Points torus_mesh(std::uint32_t around, std::uint32_t across) {
  Points mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double a = 2.0 * std::numbers::pi * i / around;
      const double b = 2.0 * std::numbers::pi * j / across;
      const double r = 1.0 + 0.3 * std::cos(b);
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b));
      const std::uint32_t next = (i + 1) % around * across;
      const std::uint32_t after = (j + 1) % across;
      mesh.triangles.push_back({i * across + j, next + j, next + after});
      mesh.triangles.push_back({i * across + j, next + after, i * across + after});
    }
  }
  return mesh;
}

TEST(Convert, AMeshOfFewPointsIsItsTriangles) {
  Points mesh = torus_mesh(60, 24);
  const ConvertResult result = must_convert(mesh);
  EXPECT_GT(count_samples(result.model), 30'000U);
  EXPECT_TRUE(result.model.is_closed);
  // Triangles bend by 15 degrees from one to the next: a twentieth of a spacing is a height's step.
  EXPECT_LT(result.report.error_rms, 0.05 * result.model.spacing);
  // Whichever way its triangles are wound.
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const ConvertResult turned = must_convert(mesh);
  EXPECT_EQ(turned.model.patches.size(), result.model.patches.size());
  EXPECT_EQ(count_samples(turned.model), count_samples(result.model));
  EXPECT_TRUE(turned.model.is_closed);
}

TEST(Convert, GivesTheSameWhateverTheFilesOrder) {
  const Points mesh = torus_mesh(200, 90);
  Points bare = mesh;
  bare.triangles.clear();
  for (const Points& scan : {mesh, bare}) {
    const ConvertResult result = must_convert(scan);
    for (const unsigned seed : {1U, 2U})
      EXPECT_TRUE(same_model(result.model, must_convert(test::shuffled(scan, seed)).model)) << seed;
  }
}

TEST(Convert, LeavesVerticesOfMeshesAsTheyAreUnlessAsked) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.5);
  Points mesh = test::square_mesh({60, 60}, 1.0, [&](double, double) { return noise(random); });
  EXPECT_EQ(must_convert(mesh).report.points_moved, 0U);
  ConvertOptions remove;
  remove.noise_removal = NoiseRemoval::AsMeasured;
  const ConvertResult result = must_convert(mesh, remove);
  EXPECT_EQ(result.report.points_moved, mesh.size());
  EXPECT_NEAR(result.report.noise, 0.5, 0.06);
  EXPECT_NEAR(result.report.error_rms, 0.5, 0.06);  // of the vertices as scanned

  // Triangles with a colour get points, which are measured where they were added.
  mesh.materials.resize(1);
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  const ConvertResult coloured = must_convert(mesh, remove);
  EXPECT_GT(coloured.report.points_added, 10'000U);
  EXPECT_GT(coloured.report.points_moved, mesh.size() / 2);
}

TEST(Convert, SaysWhyItCannot) {
  const auto message = [](const Points& points) {
    Progress progress;
    const Result<ConvertResult> result = convert(points, {}, progress);
    return result ? std::string() : result.error().message;
  };
  EXPECT_NE(message({}).find("0 distinct points"), std::string::npos);
  Points few = test::sample_sphere(10);
  EXPECT_NE(message(few).find("10 distinct points"), std::string::npos);
  Points line;
  for (int i = 0; i < 100; ++i) line.positions.emplace_back(i, 2.0 * i, 0.5 * i + 1.0);
  EXPECT_NE(message(line).find("one line"), std::string::npos);
}

TEST(Convert, RefusesAnImpossibleSpacing) {
  ConvertOptions options;
  options.spacing = 1e-9;
  Progress progress;
  const Result<ConvertResult> result = convert(test::sample_sphere(1000), options, progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("--spacing"), std::string::npos);
}

TEST(Convert, CanBeCancelled) {
  struct Impatient : Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } progress;
  const Result<ConvertResult> result = convert(test::sample_sphere(1000), {}, progress);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("interrupted"), std::string::npos);
}

}  // namespace
}  // namespace relief

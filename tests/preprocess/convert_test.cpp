#include "preprocess/convert.h"

#include <gtest/gtest.h>

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
  EXPECT_LE(result.report.uncovered_points, 40U);
  EXPECT_GE(result.report.uncovered_points, 30U);
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

#include "preprocess/texture/acquisition/acquire_texture.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>

#include "tests/preprocess/texture/textures.h"

namespace relief::test {
namespace {

constexpr Acquisition kAll[] = {Acquisition::Given, Acquisition::ViewIndependent,
                                Acquisition::Optimised};
constexpr std::size_t kPoints = 1600;  // 40 x 40 on the unit square

AcquireResult acquire(const Points& mesh, const Image& texture, const AcquireOptions& options) {
  Progress progress;
  auto result = acquire_texture(mesh, texture, options, progress);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *std::move(result) : AcquireResult{};
}

std::string failure(const Points& mesh, const Image& texture, std::size_t points = 100) {
  Progress progress;
  const auto result =
      acquire_texture(mesh, texture, {Acquisition::Optimised, points, 1.0, 1.0, {}}, progress);
  EXPECT_FALSE(result);
  return result ? std::string() : result.error().message;
}

/// The rms of f_c, red, against value(x, y) on the unit square: Eq. (9) summed here by itself.
template <class Function>
double error_on_square(const TexturedSplats& splats, Function&& value) {
  constexpr int kSide = 120;
  double squared = 0.0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const glm::dvec3 q((i + 0.5) / kSide, (j + 0.5) / kSide, 0.0);
      double sum = 0.0;
      double weights = 0.0;
      for (std::size_t k = 0; k < splats.positions.size(); ++k) {
        const glm::dvec3 d = (q - splats.positions[k]) / splats.deviation;
        const double exponent = 0.5 * glm::dot(d, d);
        if (exponent >= 1.0) continue;
        sum += std::exp(-exponent) * static_cast<double>(splats.colours[k].r);
        weights += std::exp(-exponent);
      }
      EXPECT_GT(weights, 0.0) << "a hole";
      squared += std::pow(sum / weights - value(q.x, q.y), 2.0);
    }
  }
  return std::sqrt(squared) / kSide;
}

TEST(AcquireTexture, AConstantTextureGivesConstantCoefficients) {
  const Image texture = make_texture(16, [](double, double) { return 0.625; });
  for (const Acquisition acquisition : kAll) {
    const AcquireResult result = acquire(unit_square(), texture, {acquisition, 500, 1.0, 1.0, {}});
    ASSERT_EQ(result.splats.colours.size(), 500U);
    for (const glm::vec3 colour : result.splats.colours) {
      // Roundings to float.
      EXPECT_LT(glm::distance(colour, glm::vec3(0.625F, 0.375F, 0.25F)), 1e-6F);
    }
    EXPECT_LT(result.report.rms_error, 1e-6);
  }
}

TEST(AcquireTexture, WithoutNormalisationAConstantStaysOneOnAverage) {
  const Image texture = make_texture(16, [](double, double) { return 1.0; });
  AcquireOptions options{Acquisition::ViewIndependent, kPoints, 1.0, 1.0, BasisKind::Plain};
  const AcquireResult projected = acquire(unit_square(), texture, options);
  for (const glm::vec3 colour : projected.splats.colours) EXPECT_NEAR(colour.r, 1.0F, 1e-6F);
  options.acquisition = Acquisition::Optimised;
  const AcquireResult optimised = acquire(unit_square(), texture, options);
  // Where the sum of the basis is not 1, the fit makes up for it as far as the basis can.
  EXPECT_LT(optimised.report.rms_error, projected.report.rms_error);
  double mean = 0.0;
  for (const glm::vec3 colour : optimised.splats.colours) mean += static_cast<double>(colour.r);
  // The border's, of 160 of the 1600 splats, are above 1.
  EXPECT_NEAR(mean / kPoints, 1.0, 0.1);
}

TEST(AcquireTexture, AWaveComesBackLessDampedThanByViewIndependentEwa) {
  // 10 splats a period: w h = 0.63. Truncated at c = 1 the Gaussian's variance along an axis is
  // h^2 (1 - 1 / (e - 1)) = 0.418 h^2, its transform exp(-0.418 * 0.63^2 / 2) = 0.921. EWA filters
  // once for the coefficients, and the sum of splats once more: 0.848 of the amplitude is left.
  const Wave wave{4.0};
  const Image texture = make_texture(256, wave);
  double error[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const AcquireResult result = acquire(unit_square(), texture, {kAll[i], kPoints, 1.0, 1.0, {}});
    error[i] = error_on_square(result.splats, wave);
    // The report's is over three channels, of which one is constant. The texture's own Gaussian
    // takes 0.5 % of the wave.
    EXPECT_NEAR(result.report.rms_error, error[i] * std::sqrt(2.0 / 3.0), 0.002);
  }
  const double amplitude_rms = 0.5 / std::numbers::sqrt2;
  // Irregular points add to what a regular grid would lose.
  EXPECT_GT(error[0], (1.0 - 0.921) * amplitude_rms);
  EXPECT_NEAR(error[1], (1.0 - 0.848) * amplitude_rms, 0.01);
  // The fit could take the given values divided by 0.921, which leaves only what irregularity
  // adds, and it must be better than that.
  const double damping = (1.0 - 0.921) * amplitude_rms;
  EXPECT_LT(error[2], std::sqrt(error[0] * error[0] - damping * damping));
}

TEST(AcquireTexture, SmoothSplatsLoseWhatTheorySaysAndTheFitBringsItBack) {
  // Cut at c = 3 splats have no visible rims, and irregularity adds little. Variance
  // h^2 (1 - 3 / (e^3 - 1)) = 0.843 h^2, transform exp(-0.843 * 0.63^2 / 2) = 0.847.
  const Wave wave{4.0};
  const Image texture = make_texture(256, wave);
  double error[3];
  for (std::size_t i = 0; i < 3; ++i) {
    error[i] = acquire(unit_square(), texture, {kAll[i], kPoints, 1.0, 3.0, {}}).report.rms_error /
               std::sqrt(2.0 / 3.0);
  }
  const double amplitude_rms = 0.5 / std::numbers::sqrt2;
  // As given, irregularity adds to the damping; a mean under the splat evens it out, but for a
  // tenth at borders, where the wave is seen from one side.
  EXPECT_GT(error[0], (1.0 - 0.847) * amplitude_rms);
  EXPECT_LT(error[0], error[1]);
  EXPECT_NEAR(error[1] / ((1.0 - 0.847 * 0.847) * amplitude_rms), 1.0, 0.1);
  // No more than a tenth of what view-independent EWA loses.
  EXPECT_LT(error[2], 0.1 * error[1]);
}

TEST(AcquireTexture, ARampComesBackAsARamp) {
  // Away from the texture's border, where it repeats.
  Points mesh = unit_square();
  for (glm::vec2& t : mesh.texcoords) t = 0.1F + 0.8F * t;
  const Image texture = make_texture(256, [](double u, double v) { return 0.5 * (u + v); });
  const auto ramp = [](double x, double y) { return 0.1 + 0.4 * (x + y); };
  const AcquireResult result =
      acquire(mesh, texture, {Acquisition::Optimised, kPoints, 1.0, 1.0, BasisKind::Normalised});
  // A tenth of what the ramp climbs from splat to splat, 0.8 / sqrt(2) / 40.
  EXPECT_LT(error_on_square(result.splats, ramp), 0.1 * 0.8 / std::numbers::sqrt2 / 40.0);
}

TEST(AcquireTexture, SplatsStandOnTheMeshWithUnitNormalsOutward) {
  Points mesh;  // an octahedron without normals
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.texcoords = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}, {0.25, 0.75}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const AcquireResult result =
      acquire(mesh, make_texture(64, Wave{2.0}), {Acquisition::Optimised, 2000, 1.0, 1.0, {}});
  ASSERT_EQ(result.splats.positions.size(), 2000U);
  EXPECT_NEAR(result.report.area, 4.0 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(result.splats.deviation, std::sqrt(4.0 * std::sqrt(3.0) / 2000.0), 1e-12);
  for (std::size_t i = 0; i < 2000; ++i) {
    const glm::dvec3 p = result.splats.positions[i];
    EXPECT_NEAR(std::abs(p.x) + std::abs(p.y) + std::abs(p.z), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(result.splats.normals[i]), 1.0F, 1e-6F);
    EXPECT_GT(glm::dot(glm::dvec3(result.splats.normals[i]), p), 0.0);
    const glm::vec3 colour = result.splats.colours[i];
    EXPECT_TRUE(std::isfinite(colour.r + colour.g + colour.b));
  }
  ASSERT_TRUE(result.report.fit);
  EXPECT_LE(result.report.fit->residual, 1e-8);
}

TEST(AcquireTexture, DoesNotDependOnTheNumberOfThreads) {
  const Image texture = make_texture(64, Wave{3.0});
  AcquireResult results[2];
  for (int i = 0; i < 2; ++i) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, i == 0 ? 1 : 4);
    results[i] = acquire(unit_square(), texture, {Acquisition::Optimised, 3000, 1.0, 1.0, {}});
  }
  EXPECT_EQ(results[0].splats.positions, results[1].splats.positions);
  EXPECT_EQ(results[0].splats.normals, results[1].splats.normals);
  EXPECT_EQ(results[0].splats.colours, results[1].splats.colours);
}

TEST(AcquireTexture, TextureCoordinatesOutsideTheUnitSquareRepeatIt) {
  Points mesh = unit_square();
  const Image texture = make_texture(64, Wave{2.0});
  const AcquireResult inside = acquire(mesh, texture, {Acquisition::Given, 300, 1.0, 1.0, {}});
  for (glm::vec2& t : mesh.texcoords) t += glm::vec2(3.0F, -5.0F);
  const AcquireResult outside = acquire(mesh, texture, {Acquisition::Given, 300, 1.0, 1.0, {}});
  for (std::size_t i = 0; i < 300; ++i) {
    // Floats near 4 are 5e-7 apart; the wave climbs by 2 pi over the texture.
    EXPECT_NEAR(outside.splats.colours[i].r, inside.splats.colours[i].r, 1e-5F);
  }
}

TEST(AcquireTexture, OnePointIsEnough) {
  const AcquireResult result =
      acquire(unit_square(), make_texture(8, Wave{1.0}), {Acquisition::Optimised, 1, 1.0, 1.0, {}});
  ASSERT_EQ(result.splats.colours.size(), 1U);
  // The mean of the wave is 0.5 under any support that is symmetric to its zero in the middle.
  EXPECT_NEAR(result.splats.colours[0].r, 0.5F, 0.25F);
}

TEST(AcquireTexture, SaysWhatIsMissing) {
  const Image texture = make_texture(4, Wave{1.0});
  Points mesh = unit_square();
  // 100,000,000 entries / (16 places * 2 pi splats at each).
  EXPECT_EQ(failure(mesh, texture, 0),
            "0 points cannot be spread; with a cutoff of 1 ask for 1 to 994718");
  EXPECT_EQ(failure(mesh, texture, SIZE_MAX),
            "18446744073709551615 points cannot be spread; with a cutoff of 1 ask for 1 to 994718");
  EXPECT_EQ(failure(mesh, Image{}), "the texture has no pixels");
  mesh.texcoords[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(failure(mesh, texture),
            "some texture coordinates are NaN or infinite; repair the mesh");
  mesh.texcoords.clear();
  EXPECT_EQ(failure(mesh, texture), "there are no texture coordinates; use a mesh that has them");
  mesh.triangles.clear();
  EXPECT_EQ(failure(mesh, texture), "there are no triangles for the texture; use a mesh");
  mesh = unit_square();
  mesh.triangles = {{0, 1, 1}, {2, 2, 2}};
  EXPECT_EQ(failure(mesh, texture), "the triangles have no area that points could be spread over");
  mesh = unit_square();
  for (glm::dvec3& p : mesh.positions) p *= 1e200;
  EXPECT_EQ(failure(mesh, texture), "the triangles have no area that points could be spread over");
}

TEST(AcquireTexture, CanBeCancelled) {
  class Cancelled final : public Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } progress;
  const auto result =
      acquire_texture(unit_square(), make_texture(4, Wave{1.0}), AcquireOptions{}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, interrupted_error().message);
}

}  // namespace
}  // namespace relief::test

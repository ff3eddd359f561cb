#include "preprocess/texture/acquisition/fit_texture.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "preprocess/texture/acquisition/even_sample.h"
#include "preprocess/texture/acquisition/splat_basis.h"
#include "tests/preprocess/texture/textures.h"

namespace relief::test {
namespace {

using FitMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Points textured_square_with_normals() {
  Points mesh = unit_square();
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  return mesh;
}

/// Splats at given positions of the unit square.
SurfacePoints splats_at(const std::vector<glm::dvec3>& positions) {
  SurfacePoints splats;
  splats.positions = positions;
  splats.normals.assign(positions.size(), glm::vec3(0, 0, 1));
  splats.texcoords.assign(positions.size(), glm::vec2(0.0F));
  return splats;
}

/// Even splats on the unit square with the basis at 16 places for each.
struct EvenSquare {
  explicit EvenSquare(std::size_t count, BasisKind kind = BasisKind::Normalised)
      : positions(spread_over_triangles(textured_square_with_normals(), 16 * count)),
        splats(
            thin_out(spread_over_triangles(textured_square_with_normals(), 4 * count), count, 1.0)),
        basis(evaluate_basis(splats, {1.0 / std::sqrt(static_cast<double>(count)), 1.0, kind},
                             positions)) {}

  SurfacePoints positions;
  SurfacePoints splats;
  BasisAtPositions basis;
};

TEST(SplatBasis, InnerProductsOfGaussiansAreGaussiansOfTheirDistance) {
  // <G_V, G_V> at distance d is G_2V(d); r_k is G_V with V = h^2 I, scaled by h^2 / (1 - e^-c).
  constexpr double kH = 0.04;
  constexpr double kCutoff = 10.0;
  const SurfacePoints splats =
      splats_at({{0.5, 0.5, 0}, {0.5 + kH, 0.5, 0}, {0.5, 0.5 + 2.0 * kH, 0}});
  const SurfacePoints positions = spread_over_triangles(textured_square_with_normals(), 400'000);
  const FitMatrix products =
      inner_products(evaluate_basis(splats, {kH, kCutoff, BasisKind::Plain}, positions));
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      const double d = glm::distance(splats.positions[static_cast<std::size_t>(k)],
                                     splats.positions[static_cast<std::size_t>(j)]);
      const double expected = std::pow(kH, 4.0) * std::exp(-d * d / (4.0 * kH * kH)) /
                              (4.0 * std::numbers::pi * kH * kH);
      // What lies beyond the cutoff is below e^-10 of a splat; 640 places in h^2 sum to 1 in 10^3.
      EXPECT_NEAR(products.coeff(k, j) / expected, 1.0, 1.5e-3) << k << ", " << j;
    }
  }
}

TEST(SplatBasis, TruncatedGaussiansHaveTheNormThatTheirSupportLeaves) {
  // Over the disc of radius sqrt(2 c) h: the integral of exp(-r^2 / h^2) is pi h^2 (1 - e^-2c).
  constexpr double kH = 0.05;
  const SurfacePoints positions = spread_over_triangles(textured_square_with_normals(), 400'000);
  for (const double cutoff : {0.5, 1.0, 3.0}) {
    const FitMatrix products = inner_products(
        evaluate_basis(splats_at({{0.5, 0.5, 0}}), {kH, cutoff, BasisKind::Plain}, positions));
    const double scale = 1.0 / (2.0 * std::numbers::pi * (1.0 - std::exp(-cutoff)));
    const double expected =
        scale * scale * std::numbers::pi * kH * kH * (1.0 - std::exp(-2.0 * cutoff));
    // 1000 places in h^2; the support's rim makes it coarser than a smooth integrand's.
    EXPECT_NEAR(products.coeff(0, 0) / expected, 1.0, 3e-3) << cutoff;
  }
}

TEST(SplatBasis, SumsToOne) {
  const EvenSquare normalised(400);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(400);
  EXPECT_NEAR((normalised.basis * ones).minCoeff(), 1.0, 1e-15);
  EXPECT_NEAR((normalised.basis * ones).maxCoeff(), 1.0, 1e-15);
  // One splat on h^2 and truncation made good: 1 on average, but for what hangs over the border. Of
  // a splat on the border that is a half, of one at 1.41 h nothing; in between about a straight
  // line. With n splats within h of the border of 400 it is n / 400 * 0.26, n between the share of
  // their area, 76, and twice that (points crowd at borders).
  const EvenSquare plain(400, BasisKind::Plain);
  EXPECT_LT((plain.basis * ones).mean(), 1.0 - 0.26 * 76.0 / 400.0 + 0.01);
  EXPECT_GT((plain.basis * ones).mean(), 1.0 - 0.26 * 152.0 / 400.0 - 0.01);
}

TEST(SplatBasis, ReachesOnlyPositionsThatFaceItsSide) {
  SurfacePoints splats = splats_at({{0.5, 0.5, 0}, {0.5, 0.5, 1e-3}});
  splats.normals[1] = glm::vec3(0, 0, -1);
  const SurfacePoints positions = spread_over_triangles(textured_square_with_normals(), 1000);
  const BasisAtPositions basis =
      evaluate_basis(splats, {0.1, 1.0, BasisKind::Normalised}, positions);
  EXPECT_GT(basis.col(0).sum(), 0.0);
  EXPECT_EQ(basis.col(1).sum(), 0.0);
}

TEST(SplatBasis, IsEvaluatedInTheTangentPlane) {
  SurfacePoints position = splats_at({{0.55, 0.5, 0.08}});
  const BasisAtPositions basis =
      evaluate_basis(splats_at({{0.5, 0.5, 0.0}}), {0.1, 1.0, BasisKind::Plain}, position);
  const double expected = std::exp(-0.5 * 0.25) / (2.0 * std::numbers::pi * (1.0 - std::exp(-1.0)));
  EXPECT_NEAR(basis.coeff(0, 0), expected, 1e-12) << "the height of 0.8 h plays no part";
}

TEST(FitTexture, TheMatrixIsSymmetricAndPositiveDefiniteAndItsConditionIsKnown) {
  for (const BasisKind kind : {BasisKind::Normalised, BasisKind::Plain}) {
    const EvenSquare square(200, kind);
    const Eigen::MatrixXd dense = Eigen::MatrixXd(inner_products(square.basis));
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-15 * dense.norm());
    const Eigen::VectorXd scale = dense.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * dense * scale.asDiagonal();
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues();
    EXPECT_GT(values.minCoeff(), 0.0);
    FitReport report;
    const std::vector<glm::vec3> zero(200, glm::vec3(0.0F));
    (void)fit_texture(square.basis,
                      std::vector<glm::vec3>(square.positions.size(), glm::vec3(1.0F)), zero,
                      Progress(), report);
    ASSERT_TRUE(report.condition);
    // Lanczos sees the ends of the spectrum from within; at a residual of 1e-9 to a percent.
    const double condition = values.maxCoeff() / values.minCoeff();
    EXPECT_LT(*report.condition, condition * (1.0 + 1e-6));
    EXPECT_GT(*report.condition, condition * 0.99);
    EXPECT_LE(report.residual, 1e-9);
  }
}

TEST(FitTexture, FindsTheCoefficientsOfAFunctionThatTheBasisHas) {
  const EvenSquare square(300);
  Eigen::VectorXd w(300);
  for (Eigen::Index k = 0; k < 300; ++k) w[k] = std::sin(static_cast<double>(3 * k * k));
  const Eigen::VectorXd function = square.basis * w;
  std::vector<glm::vec3> texture(square.positions.size());
  for (std::size_t q = 0; q < texture.size(); ++q) {
    const auto value = static_cast<float>(function[static_cast<Eigen::Index>(q)]);
    texture[q] = glm::vec3(value, -2.0F * value, 0.0F);
  }
  FitReport report;
  const std::vector<glm::vec3> zero(300, glm::vec3(0.0F));
  const std::vector<glm::vec3> fit = fit_texture(square.basis, texture, zero, Progress(), report);
  for (std::size_t k = 0; k < 300; ++k) {
    const auto expected = static_cast<float>(w[static_cast<Eigen::Index>(k)]);
    // Rounding to float (6e-8), times the square root of a condition below 1000, times two.
    EXPECT_NEAR(fit[k].r, expected, 4e-6F);
    EXPECT_NEAR(fit[k].g, -2.0F * expected, 8e-6F);
    EXPECT_EQ(fit[k].b, 0.0F);
  }
  EXPECT_LT(rms_error(square.basis, fit, texture), 1e-6);
}

TEST(FitTexture, NoOtherCoefficientsHaveALessError) {
  const EvenSquare square(150);
  std::vector<glm::vec3> texture(square.positions.size());
  for (std::size_t q = 0; q < texture.size(); ++q) {
    texture[q] = glm::vec3(square.positions.positions[q].x > 0.37 ? 1.0F : 0.0F);
  }
  FitReport report;
  const std::vector<glm::vec3> start(150, glm::vec3(0.5F));
  const std::vector<glm::vec3> fit = fit_texture(square.basis, texture, start, Progress(), report);
  const double least = rms_error(square.basis, fit, texture);
  for (std::size_t k = 0; k < 150; ++k) {
    for (const float step : {-0.05F, 0.05F}) {
      std::vector<glm::vec3> other = fit;
      other[k] += step;
      EXPECT_GT(rms_error(square.basis, other, texture), least);
    }
  }
}

TEST(ProjectTexture, IsTheWeightedMeanAndKeepsSplatsThatReachNoPosition) {
  BasisAtPositions basis(2, 3);
  basis.insert(0, 0) = 0.75;
  basis.insert(0, 1) = 0.25;
  basis.insert(1, 0) = 0.25;
  const std::vector<glm::vec3> w = project_texture(basis, {glm::vec3(4, 8, 0), glm::vec3(0, 4, 1)},
                                                   std::vector<glm::vec3>(3, glm::vec3(9.0F)));
  EXPECT_EQ(w[0], glm::vec3(3.0F, 7.0F, 0.25F));
  EXPECT_EQ(w[1], glm::vec3(4.0F, 8.0F, 0.0F));
  EXPECT_EQ(w[2], glm::vec3(9.0F));
}

}  // namespace
}  // namespace relief::test

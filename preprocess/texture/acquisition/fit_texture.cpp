#include "preprocess/texture/acquisition/fit_texture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "preprocess/texture/acquisition/solve_spd.h"

namespace relief {
namespace {

// Against 8-bit steps (0.004) times a condition of some thousands nothing is left of this.
constexpr double kTolerance = 1e-9;
// Conditions met (docs/accuracy_texture.md) take some hundreds.
constexpr int kMaxIterations = 5000;

Eigen::VectorXd channel_of(const std::vector<glm::vec3>& colours, glm::length_t channel) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(colours.size()));
  for (std::size_t i = 0; i < colours.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = static_cast<double>(colours[i][channel]);
  }
  return values;
}

void set_channel(std::vector<glm::vec3>& colours, glm::length_t channel,
                 const Eigen::VectorXd& values) {
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i][channel] = static_cast<float>(values[static_cast<Eigen::Index>(i)]);
  }
}

/// A right side that has a share of every eigenvector: the golden ratio's multiples, which repeat
/// nothing.
Eigen::VectorXd scattered(Eigen::Index size) {
  constexpr double kStep = 0.6180339887498949;
  Eigen::VectorXd values(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double x = kStep * static_cast<double>(i);
    values[i] = x - std::floor(x) - 0.5;
  }
  return values;
}

}  // namespace

std::vector<glm::vec3> project_texture(const BasisAtPositions& basis,
                                       const std::vector<glm::vec3>& texture,
                                       const std::vector<glm::vec3>& fallback) {
  std::vector<glm::dvec3> sums(fallback.size(), glm::dvec3(0.0));
  std::vector<double> weights(fallback.size(), 0.0);
  for (Eigen::Index q = 0; q < basis.outerSize(); ++q) {
    const glm::dvec3 value(texture[static_cast<std::size_t>(q)]);
    for (BasisAtPositions::InnerIterator entry(basis, q); entry; ++entry) {
      const auto k = static_cast<std::size_t>(entry.col());
      sums[k] += entry.value() * value;
      weights[k] += entry.value();
    }
  }
  std::vector<glm::vec3> coefficients = fallback;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (weights[k] > 0.0) coefficients[k] = glm::vec3(sums[k] / weights[k]);
  }
  return coefficients;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> inner_products(const BasisAtPositions& basis) {
  const BasisAtPositions by_splat = basis.transpose();
  Eigen::SparseMatrix<double, Eigen::RowMajor> products = by_splat * basis;
  products *= 1.0 / static_cast<double>(std::max<Eigen::Index>(basis.rows(), 1));
  return products;
}

std::vector<glm::vec3> fit_texture(const BasisAtPositions& basis,
                                   const std::vector<glm::vec3>& texture,
                                   const std::vector<glm::vec3>& start, const Progress& progress,
                                   FitReport& report) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> matrix = inner_products(basis);
  const double share = 1.0 / static_cast<double>(std::max<Eigen::Index>(basis.rows(), 1));
  std::array<SpdSolution, 4> solutions;  // red, green, blue, and one to estimate the condition with
  tbb::parallel_for(glm::length_t{0}, glm::length_t{4}, [&](glm::length_t c) {
    const Eigen::Index unknowns = matrix.rows();
    const Eigen::VectorXd right_side =
        c < 3 ? Eigen::VectorXd(share * (basis.transpose() * channel_of(texture, c)))
              : scattered(unknowns);
    const Eigen::VectorXd from =
        c < 3 ? channel_of(start, c) : Eigen::VectorXd(Eigen::VectorXd::Zero(unknowns));
    solutions[static_cast<std::size_t>(c)] =
        solve_spd(matrix, right_side, from, kTolerance, kMaxIterations, progress);
  });
  std::vector<glm::vec3> coefficients = start;
  for (glm::length_t c = 0; c < 3; ++c) {
    const SpdSolution& solution = solutions[static_cast<std::size_t>(c)];
    set_channel(coefficients, c, solution.x);
    report.iterations = std::max(report.iterations, solution.iterations);
    report.residual = std::max(report.residual, solution.residual);
  }
  report.condition = solutions[3].condition;
  return coefficients;
}

double rms_error(const BasisAtPositions& basis, const std::vector<glm::vec3>& coefficients,
                 const std::vector<glm::vec3>& texture) {
  double squared = 0.0;
  for (glm::length_t c = 0; c < 3; ++c) {
    squared += (basis * channel_of(coefficients, c) - channel_of(texture, c)).squaredNorm();
  }
  return std::sqrt(squared / (3.0 * static_cast<double>(std::max<std::size_t>(texture.size(), 1))));
}

}  // namespace relief

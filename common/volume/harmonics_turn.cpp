#include "common/volume/harmonics_turn.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace relief {
namespace {

/// Nodes and weights of Gauss and Legendre on -1 to 1: exact to degree 9.
struct LegendreNode {
  double place;
  double weight;
};
constexpr std::array<LegendreNode, 5> kLegendre{{{-0.9061798459386640, 0.2369268850561891},
                                                 {-0.5384693101056831, 0.4786286704993665},
                                                 {0.0, 0.5688888888888889},
                                                 {0.5384693101056831, 0.4786286704993665},
                                                 {0.9061798459386640, 0.2369268850561891}}};

/// Equal steps about the axis: exact for products of two harmonics of degree 4, whose frequency is
/// 8 at most.
constexpr int kMeridians = 9;

}  // namespace

HarmonicsTurn::HarmonicsTurn(const glm::dmat3& q, int degree) : degree_(degree) {
  assert(degree >= 0 && degree <= kMaxHarmonicsDegree && "a degree of harmonics");
  // The basis is orthonormal, so that entry (i, j) is the integral of b_i(Q d) b_j(d) over the
  // sphere. The sum below is exact for polynomials of this degree.
  for (const LegendreNode& node : kLegendre) {
    const double radius = std::sqrt(1.0 - node.place * node.place);
    const double weight = node.weight * 2.0 * std::numbers::pi / kMeridians;
    for (int m = 0; m < kMeridians; ++m) {
      const double angle = 2.0 * std::numbers::pi * m / kMeridians;
      const glm::dvec3 d(radius * std::cos(angle), radius * std::sin(angle), node.place);
      std::array<double, kCount> before{};
      std::array<double, kCount> after{};
      harmonics_basis(d, degree, before);
      harmonics_basis(glm::normalize(q * d), degree, after);
      for (int l = 0; l <= degree; ++l) {
        for (std::size_t i = harmonics_of(l - 1); i < harmonics_of(l); ++i) {
          for (std::size_t j = harmonics_of(l - 1); j < harmonics_of(l); ++j)
            matrix_[i][j] += weight * after[i] * before[j];
        }
      }
    }
  }
}

void HarmonicsTurn::apply(std::span<glm::vec3> coefficients) const {
  assert(coefficients.size() == harmonics_of(degree_) && "all coefficients of a Gaussian");
  std::array<glm::dvec3, kCount> before{};
  std::copy(coefficients.begin(), coefficients.end(), before.begin());
  for (int l = 1; l <= degree_; ++l) {  // the colour of degree 0 has no direction
    for (std::size_t i = harmonics_of(l - 1); i < harmonics_of(l); ++i) {
      glm::dvec3 sum(0.0);
      for (std::size_t j = harmonics_of(l - 1); j < harmonics_of(l); ++j)
        sum += matrix_[i][j] * before[j];
      coefficients[i] = glm::vec3(sum);
    }
  }
}

}  // namespace relief

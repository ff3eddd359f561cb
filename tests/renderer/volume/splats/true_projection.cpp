#include "true_projection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace relief {
namespace {

/// Beyond so many standard deviations a Gaussian is below 1e-21 of its peak.
constexpr double kReachOfGaussian = 10.0;
/// Pieces of the ray to begin with: none is longer than half a deviation where kernels are round.
constexpr int kPieces = 64;
constexpr int kDeepest = 24;

/// Adaptive Simpson integration of a function of one number.
template <class Function>
class Simpson {
 public:
  explicit Simpson(Function function) : function_(function) {}

  [[nodiscard]] double over(double low, double high, double tolerance) const {
    const double middle = 0.5 * (low + high);
    const Ends ends{function_(low), function_(middle), function_(high)};
    return refined(low, high, ends, tolerance, kDeepest);
  }

 private:
  struct Ends {
    double low;
    double middle;
    double high;
  };

  static double rule(double length, const Ends& at) {
    return length / 6.0 * (at.low + 4.0 * at.middle + at.high);
  }

  [[nodiscard]] double refined(double low, double high, const Ends& at, double tolerance,
                               int depth) const {
    const double middle = 0.5 * (low + high);
    const Ends left{at.low, function_(0.5 * (low + middle)), at.middle};
    const Ends right{at.middle, function_(0.5 * (middle + high)), at.high};
    const double coarse = rule(high - low, at);
    const double fine = rule(middle - low, left) + rule(high - middle, right);
    if (depth == 0 || std::abs(fine - coarse) <= 15.0 * tolerance)
      return fine + (fine - coarse) / 15.0;
    return refined(low, middle, left, 0.5 * tolerance, depth - 1) +
           refined(middle, high, right, 0.5 * tolerance, depth - 1);
  }

  Function function_;
};

}  // namespace

double integral_along(const TrueKernel& kernel, glm::dvec3 through) {
  const glm::dvec3 direction = glm::normalize(through);
  const glm::dmat3 variance = matrix_of(kernel.variance);
  const glm::dmat3 conic = glm::inverse(variance);
  const double peak =
      std::pow(2.0 * std::numbers::pi, -1.5) / std::sqrt(glm::determinant(variance));
  const auto density = [&](double along) {
    const glm::dvec3 off = along * direction - kernel.centre;
    return peak * std::exp(-0.5 * glm::dot(off, conic * off));
  };
  // Where the ray is nearest to the centre, in the kernel's own measure, and how wide it is there.
  const double narrow = glm::dot(direction, conic * direction);
  const double nearest = glm::dot(direction, conic * kernel.centre) / narrow;
  const double reach = kReachOfGaussian / std::sqrt(narrow);
  const double low = std::max(nearest - reach, 0.0);
  const double high = nearest + reach;
  if (!(high > low)) return 0.0;
  const double tolerance = 1e-10 * peak / std::sqrt(narrow) / kPieces;
  const Simpson simpson(density);
  double sum = 0.0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const auto place = [&](int p) { return low + (high - low) * p / kPieces; };
    sum += simpson.over(place(piece), place(piece + 1), tolerance);
  }
  return sum;
}

RayCamera camera_along_z(double focal) {
  RayCamera camera;
  camera.scale = glm::dvec2(focal);
  return camera;
}

glm::dvec3 centre_at(double degrees) {
  const double angle = glm::radians(degrees);
  return {std::sin(angle), 0.0, std::cos(angle)};
}

Variance round_variance(double sigma) {
  const double v = sigma * sigma;
  return {v, 0.0, 0.0, v, 0.0, v};
}

}  // namespace relief

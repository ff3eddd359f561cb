// How far the affine footprint of a round kernel is off its true projection, over the angle from
// the view axis and the kernel's size; and of round and flattened kernels over the distance from
// the centre in the image, by numerical integration: `footprint_experiment`, without arguments.
// Tables in Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "../renderer/volume/splats/true_projection.h"
#include "renderer/volume/splats/footprint.h"

using namespace relief;

namespace {

/// Of a pixel grid: fine enough for the smallest kernel below, 8 pixels a standard deviation.
constexpr double kFocal = 800.0;
constexpr double kReach = 5.0;

/// The integral of a unit round Gaussian of weight 1 along a ray from the eye, for a centre `c`.
double true_depth(glm::dvec3 c, double sigma, glm::dvec3 direction) {
  const glm::dvec3 d = glm::normalize(direction);
  const double along = glm::dot(c, d);
  const glm::dvec3 off = c - along * d;
  const double before_eye = 0.5 * std::erfc(-along / (sigma * std::numbers::sqrt2));
  return before_eye * std::exp(-0.5 * glm::dot(off, off) / (sigma * sigma)) /
         (2.0 * std::numbers::pi * sigma * sigma);
}

struct FootprintError {
  double largest = 0.0;  ///< share of the true peak
  double total = 0.0;    ///< of the sum over the image, share
};

std::optional<Footprint> footprint_at(glm::dvec3 centre, const Variance& variance) {
  KernelCloud cloud;
  cloud.centres = {centre};
  cloud.variances = {variance};
  cloud.weights = {1.0F};
  FootprintRule rule;
  rule.filter = VolumeFilter::Unfiltered;
  rule.cutoff = kReach * kReach;
  return footprint_of(cloud, 0, camera_along_z(kFocal), rule);
}

/// For a kernel at distance 1, `degrees` off the axis. Fields of view wide enough to show it.
FootprintError error_of(double degrees, double sigma) {
  const glm::dvec3 centre = centre_at(degrees);
  const auto footprint = footprint_at(centre, round_variance(sigma));
  if (!footprint) return {};
  double peak = 0.0;
  double sum = 0.0;
  double sum_of_footprint = 0.0;
  FootprintError error;
  const glm::dvec2 reach = 2.0 * footprint->reach;
  for (double y = -reach.y; y <= reach.y; y += 1.0) {
    for (double x = -reach.x; x <= reach.x; x += 1.0) {
      const glm::dvec2 at = footprint->centre + glm::dvec2(x, y);
      const double truth = true_depth(centre, sigma, glm::dvec3(at / kFocal, 1.0));
      const double q = footprint->q({x, y});
      const double splat = q < footprint->cutoff ? footprint->peak * std::exp(-0.5 * q) : 0.0;
      peak = std::max(peak, truth);
      sum += truth;
      sum_of_footprint += splat;
      error.largest = std::max(error.largest, std::abs(splat - truth));
    }
  }
  error.largest /= peak;
  error.total = sum_of_footprint / sum - 1.0;
  return error;
}

/// The largest error in a ring around the centre, share of the splat's peak: `deviations` standard
/// deviations of the footprint away, by numerical integration along the rays there.
double error_in_ring(glm::dvec3 centre, const Variance& variance, double deviations) {
  constexpr int kDirections = 64;
  const auto splat = footprint_at(centre, variance);
  if (!splat) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (int d = 0; d < kDirections; ++d) {
    const double angle = 2.0 * std::numbers::pi * d / kDirections;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    const glm::dvec2 off = direction * (deviations / std::sqrt(splat->q(direction)));
    const double drawn = splat->peak * std::exp(-0.5 * splat->q(off));
    const glm::dvec3 through((splat->centre + off) / kFocal, 1.0);
    largest = std::max(largest, std::abs(drawn - integral_along({centre, variance}, through)));
  }
  return largest / splat->peak;
}

void print_rings(const char* what, double sigma, const Variance& variance) {
  fmt::print("\n{}, sigma {}\n\n", what, sigma);
  fmt::print("| degrees off the axis | 0 | 0.5 | 1 | 1.5 | 2 | 3 |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
    fmt::print("| {:.0f} |", degrees);
    for (const double deviations : {0.0, 0.5, 1.0, 1.5, 2.0, 3.0})
      fmt::print(" {:.3f} |", 100.0 * error_in_ring(centre_at(degrees), variance, deviations));
    fmt::print("\n");
  }
}

/// Of a kernel that is flattened across a normal 60 degrees off the z axis, towards y.
Variance leaning_sheet(double sigma) {
  const glm::dvec3 normal(0.0, std::sin(glm::radians(60.0)), std::cos(glm::radians(60.0)));
  const glm::dmat3 across = glm::outerProduct(normal, normal);
  return variance_of(sigma * sigma * (glm::dmat3(1.0) - across + 1e-4 * across));
}

}  // namespace

int main() {
  fmt::print("| degrees off the axis | sigma 0.01 | 0.03 | 0.1 | 0.2 |\n");
  fmt::print("| --- | --- | --- | --- | --- |\n");
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
    fmt::print("| {:.0f} |", degrees);
    for (const double sigma : {0.01, 0.03, 0.1, 0.2}) {
      const FootprintError error = error_of(degrees, sigma);
      fmt::print(" {:.2f} / {:+.2f} |", 100.0 * error.largest, 100.0 * error.total);
    }
    fmt::print("\n");
  }
  print_rings("Round", 0.01, round_variance(0.01));
  print_rings("Round", 0.05, round_variance(0.05));
  print_rings("Flattened to a hundredth, leaning by 60 degrees", 0.01, leaning_sheet(0.01));
  return 0;
}

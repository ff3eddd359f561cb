// How far the affine footprint of a round kernel is off its true projection, over the angle from
// the view axis and the kernel's size: `footprint_experiment`, without arguments. A table in
// Markdown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "renderer/volume/footprint.h"

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

struct Error {
  double largest = 0.0;  ///< share of the true peak
  double total = 0.0;    ///< of the sum over the image, share
};

/// For a kernel at distance 1, `degrees` off the axis. Fields of view wide enough to show it.
Error error_of(double degrees, double sigma) {
  const double angle = glm::radians(degrees);
  RayCamera camera;
  camera.scale = glm::dvec2(kFocal);
  KernelCloud cloud;
  const glm::dvec3 centre(std::sin(angle), 0.0, std::cos(angle));
  cloud.centres = {centre};
  const double v = sigma * sigma;
  cloud.variances = {{v, 0.0, 0.0, v, 0.0, v}};
  cloud.weights = {1.0F};
  FootprintRule rule;
  rule.filter = VolumeFilter::Unfiltered;
  rule.cutoff = kReach * kReach;
  const auto footprint = footprint_of(cloud, 0, camera, rule);
  if (!footprint) return {};
  double peak = 0.0;
  double sum = 0.0;
  double sum_of_footprint = 0.0;
  Error error;
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

}  // namespace

int main() {
  fmt::print("| degrees off the axis | sigma 0.01 | 0.03 | 0.1 | 0.2 |\n");
  fmt::print("| --- | --- | --- | --- | --- |\n");
  for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
    fmt::print("| {:.0f} |", degrees);
    for (const double sigma : {0.01, 0.03, 0.1, 0.2}) {
      const Error error = error_of(degrees, sigma);
      fmt::print(" {:.2f} / {:+.2f} |", 100.0 * error.largest, 100.0 * error.total);
    }
    fmt::print("\n");
  }
  return 0;
}

#include "models/knot_scan.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace relief {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory holds it");

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kTubeRadius = 0.5;
// The centre line's length over the tube's circumference: makes points equally far apart both
// methods.
constexpr double kLengthToGirth = 10.0;

/// The (2, 3) torus knot, t in [0, 1).
glm::dvec3 centre_line(double t) {
  const double a = kTwoPi * t;
  const double ring = 2.0 + std::cos(3.0 * a);
  return {ring * std::cos(2.0 * a), ring * std::sin(2.0 * a), std::sin(3.0 * a)};
}

/// The knot's surface at t along and s around the tube, both in [0, 1).
glm::dvec3 surface(double t, double s) {
  constexpr double kStep = 1e-4;
  const glm::dvec3 centre = centre_line(t);
  const glm::dvec3 along = glm::normalize(centre_line(t + kStep) - centre_line(t - kStep));
  // The line never runs straight along Z, so that this frame turns smoothly and closes.
  const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(side, along);
  const double bumps = 0.04 * std::sin(kTwoPi * 5.0 * s) * std::sin(kTwoPi * 40.0 * t);
  const double around = kTwoPi * s;
  return centre + (kTubeRadius + bumps) * (std::cos(around) * side + std::sin(around) * up);
}

std::uint8_t channel(double wave) {
  return static_cast<std::uint8_t>(std::lround(127.5 + 100.0 * std::sin(kTwoPi * wave)));
}

void append_float(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xFFU);
}

}  // namespace

std::string knot_scan_ply(std::size_t points) {
  const auto around = static_cast<std::size_t>(
      std::lround(std::sqrt(static_cast<double>(points) / kLengthToGirth)) + 1);
  const std::size_t along = points / around + 1;
  std::string ply = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment a generated knot\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      along * around);
  for (std::size_t i = 0; i < along; ++i) {
    for (std::size_t j = 0; j < around; ++j) {
      const double t = static_cast<double>(i) / static_cast<double>(along);
      // Every other ring is turned by half a step, as a scanner would not line its points up.
      const double s =
          (static_cast<double>(j) + (i % 2 == 0 ? 0.0 : 0.5)) / static_cast<double>(around);
      const glm::dvec3 p = surface(t, s);
      append_float(ply, p.x);
      append_float(ply, p.y);
      append_float(ply, p.z);
      ply += static_cast<char>(channel(3.0 * t));
      ply += static_cast<char>(channel(3.0 * t + 1.0 / 3.0));
      ply += static_cast<char>(channel(s));
    }
  }
  return ply;
}

}  // namespace relief

#include "renderer/shading/environment/rough_environment.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "renderer/shading/environment/make_cube.h"

namespace relief {
namespace {

constexpr std::uint32_t kSmallestRoughFace = 32;
/// More texels would take more than 4 seconds of one core; 256 take one, 32 a tenth.
constexpr std::uint32_t kLargestRoughFace = 512;
/// Directions for each texel: many where there are few texels. Few are looked up in coarser copies,
/// which blurs: 128 flatten a gradient at roughness 1 by 3.6 %, 1024 by 0.3 %.
constexpr std::uint32_t kFewestSamples = 128;
constexpr std::uint32_t kMaxSamples = 1024;
constexpr std::uint32_t kLookups = 1U << 23U;

/// A direction about the normal +Z, and what is looked up there.
struct Sample {
  glm::vec3 direction{0.0F};
  float weight = 0.0F;
  std::size_t level = 0;  ///< which copy of the environment
};

/// An environment with one texel more around each face, so that bilinear lookups need no other.
struct PaddedCube {
  std::uint32_t size = 0;  ///< without those
  std::array<std::vector<glm::vec3>, 6> faces{};
};

PaddedCube pad(const CubeMap& cube) {
  PaddedCube padded;
  padded.size = cube.size;
  const std::size_t side = cube.size + 2;
  for (std::size_t face = 0; face < 6; ++face) {
    padded.faces[face].resize(side * side);
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        const bool inside = x > 0 && y > 0 && x + 1 < side && y + 1 < side;
        const glm::dvec2 st = (2.0 * glm::dvec2(x, y) - 1.0) / static_cast<double>(cube.size) - 1.0;
        padded.faces[face][y * side + x] = inside ? cube.faces[face][(y - 1) * cube.size + x - 1]
                                                  : look_up(cube, cube_direction(face, st));
      }
    }
  }
  return padded;
}

/// Half as many texels along a side, each the mean of four.
CubeMap halve(const CubeMap& cube) {
  CubeMap half;
  half.size = cube.size / 2;
  for (std::size_t face = 0; face < 6; ++face) {
    const std::vector<glm::vec3>& from = cube.faces[face];
    for (std::size_t y = 0; y < half.size; ++y) {
      for (std::size_t x = 0; x < half.size; ++x) {
        const std::size_t at = 2 * y * cube.size + 2 * x;
        half.faces[face].push_back(
            0.25F * (from[at] + from[at + 1] + from[at + cube.size] + from[at + cube.size + 1]));
      }
    }
  }
  return half;
}

std::vector<PaddedCube> make_levels(const CubeMap& environment) {
  std::vector<PaddedCube> levels;
  CubeMap level = environment;
  levels.push_back(pad(level));
  while (level.size > 1) {
    level = halve(level);
    levels.push_back(pad(level));
  }
  return levels;
}

/// Bilinear, of a direction of any length but 0.
glm::vec3 look_up_padded(const PaddedCube& cube, glm::vec3 d) {
  const glm::vec3 a = glm::abs(d);
  std::size_t face = 0;
  glm::vec2 st;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x > 0.0F ? 0 : 1;
    st = glm::vec2(d.x > 0.0F ? -d.z : d.z, -d.y) / a.x;
  } else if (a.y >= a.z) {
    face = d.y > 0.0F ? 2 : 3;
    st = glm::vec2(d.x, d.y > 0.0F ? d.z : -d.z) / a.y;
  } else {
    face = d.z > 0.0F ? 4 : 5;
    st = glm::vec2(d.z > 0.0F ? d.x : -d.x, -d.y) / a.z;
  }
  const auto size = static_cast<float>(cube.size);
  const glm::vec2 at =
      glm::clamp((st + 1.0F) * (0.5F * size) + 0.5F, glm::vec2(0.0F), glm::vec2(size + 0.999F));
  const auto x = static_cast<std::size_t>(at.x);
  const auto y = static_cast<std::size_t>(at.y);
  const glm::vec2 part = at - glm::vec2(x, y);
  const std::size_t side = cube.size + 2;
  const glm::vec3* const texel = cube.faces[face].data() + y * side + x;
  return glm::mix(glm::mix(texel[0], texel[1], part.x),
                  glm::mix(texel[side], texel[side + 1], part.x), part.y);
}

double radical_inverse(std::uint32_t k) {
  double value = 0.0;
  for (double digit = 0.5; k > 0; k >>= 1U, digit /= 2.0) value += digit * (k & 1U);
  return value;
}

/// Reflections about half vectors that are distributed as the microfacets' normals.
std::vector<Sample> make_samples(double roughness, const CubeMap& environment, std::size_t levels) {
  const std::uint32_t needed = rough_size(environment, roughness);
  const std::uint32_t count =
      std::clamp(kLookups / (6 * needed * needed), kFewestSamples, kMaxSamples);
  const double size = environment.size;
  const double pi = glm::pi<double>();
  const double squared = std::pow(roughness, 4.0);  // alpha^2
  std::vector<Sample> samples;
  double sum = 0.0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double u = (k + 0.5) / count;
    const double cosine2 = (1.0 - u) / (1.0 + (squared - 1.0) * u);  // of the half vector
    const double cosine = 2.0 * cosine2 - 1.0;
    if (cosine <= 0.0) continue;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const double turn = 2.0 * pi * radical_inverse(k);
    const double spread = cosine2 * (squared - 1.0) + 1.0;
    const double density = squared / (4.0 * pi * spread * spread);
    // A sample stands for as much of the sphere as the texels that it reads have.
    const double texels = 6.0 * size * size / (4.0 * pi * count * density);
    const double level = std::clamp(0.5 * std::log2(std::max(texels, 1.0)) + 0.5, 0.0,
                                    static_cast<double>(levels - 1));
    samples.push_back({glm::vec3(sine * std::cos(turn), sine * std::sin(turn), cosine),
                       static_cast<float>(cosine), static_cast<std::size_t>(level)});
    sum += cosine;
  }
  for (Sample& sample : samples) sample.weight /= static_cast<float>(sum);
  return samples;
}

}  // namespace

std::uint32_t rough_size(const CubeMap& environment, double roughness) {
  // GGX is at half its height at tan = 0.644 alpha, which reflection doubles; a texel is 2 / size.
  const double wanted = 2.0 * 2.0 / (1.29 * roughness * roughness);
  const double most = std::min(environment.size, kLargestRoughFace);
  const double size = std::clamp(wanted, std::min(double{kSmallestRoughFace}, most), most);
  return std::bit_ceil(static_cast<std::uint32_t>(size));
}

CubeMap prefilter(const CubeMap& environment, double roughness, std::uint32_t size) {
  assert(roughness > 0.0 && roughness <= 1.0 && "a mirror that is rough");
  const std::vector<PaddedCube> levels = make_levels(environment);
  const std::vector<Sample> samples = make_samples(roughness, environment, levels.size());
  return make_cube(size, [&](std::size_t face, glm::dvec2 st) {
    const glm::vec3 n(glm::normalize(cube_direction(face, st)));
    const glm::vec3 beside =
        std::abs(n.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 u = glm::normalize(glm::cross(beside, n));
    const glm::vec3 v = glm::cross(n, u);
    glm::vec3 light(0.0F);
    for (const Sample& sample : samples) {
      const glm::vec3& d = sample.direction;
      light += sample.weight * look_up_padded(levels[sample.level], d.x * u + d.y * v + d.z * n);
    }
    return light;
  });
}

}  // namespace relief

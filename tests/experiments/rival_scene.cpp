#include "tests/experiments/rival_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "common/image/srgb.h"
#include "renderer/engines/raytrace/sampling.h"
#include "renderer/view/view.h"

namespace relief::experiment {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory holds it");

/// A step along a ray is the distance from the surface along the radius over this, which is more
/// than the steepest bump (0.06 * 7 * 3^0.5) makes of it.
constexpr double kCaution = 1.5;
constexpr double kThere = 1e-7;
constexpr int kMostSteps = 2000;

void append(std::string& bytes, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xFFU);
}

/// Directions of length 1.
std::vector<glm::dvec3> directions(std::size_t count, PointPattern pattern) {
  std::mt19937_64 random(1);
  const auto next = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double spacing = std::sqrt(4.0 * std::numbers::pi / static_cast<double>(count));
  std::vector<glm::dvec3> all;
  all.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const bool even = pattern == PointPattern::Even;
    const auto place = static_cast<double>(k);
    const double z = 1.0 - 2.0 * (even ? (place + 0.5) / static_cast<double>(count) : next());
    const double turn = even ? golden * place : 2.0 * std::numbers::pi * next();
    const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
    glm::dvec3 d(across * std::cos(turn), across * std::sin(turn), z);
    if (even) d += 2.0 / 3.0 * spacing * (glm::dvec3(next(), next(), next()) - 0.5);
    all.push_back(glm::normalize(d));
  }
  return all;
}

}  // namespace

double radius_along(const RivalScene& scene, glm::dvec3 direction) {
  const glm::dvec3 p = scene.frequency * direction;
  return 1.0 + scene.bumps * std::sin(p.x + 1.0) * std::sin(p.y + 2.0) * std::sin(p.z + 0.5);
}

glm::vec3 colour_at(const RivalScene& scene, glm::dvec3 place) {
  const glm::dvec3 cube = glm::floor(place / scene.cube);
  const auto parity = static_cast<std::int64_t>(cube.x + cube.y + cube.z) & 1;
  const glm::vec3 tint(0.85 + 0.15 * std::sin(2.0 * place.x), 0.85 + 0.15 * std::sin(3.0 * place.y),
                       0.85 + 0.15 * std::sin(4.0 * place.z));
  return (parity == 0 ? scene.light : scene.dark) * tint;
}

std::optional<glm::dvec3> meet(const RivalScene& scene, glm::dvec3 eye, glm::dvec3 ray) {
  const glm::dvec3 way = glm::normalize(ray);
  const double largest = 1.0 + scene.bumps;
  const double nearest = -glm::dot(eye, way);
  const double squared = nearest * nearest - glm::dot(eye, eye) + largest * largest;
  if (squared < 0.0) return std::nullopt;
  double along = nearest - std::sqrt(squared);
  const double end = nearest + std::sqrt(squared);
  for (int step = 0; step < kMostSteps && along <= end; ++step) {
    const glm::dvec3 p = eye + along * way;
    const double outside = glm::length(p) - radius_along(scene, glm::normalize(p));
    if (outside < kThere) return p;
    along += outside / kCaution;
  }
  return std::nullopt;
}

std::string scan_ply(const RivalScene& scene, std::size_t count, PointPattern pattern) {
  std::string ply = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment a generated bumpy sphere\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      count);
  for (const glm::dvec3& direction : directions(count, pattern)) {
    const glm::dvec3 p = radius_along(scene, direction) * direction;
    for (glm::length_t c = 0; c < 3; ++c) append(ply, p[c]);
    const glm::vec3 colour = colour_at(scene, p);
    for (glm::length_t c = 0; c < 3; ++c) ply += static_cast<char>(srgb8_from_linear(colour[c]));
  }
  return ply;
}

Image draw_truth(const RivalScene& scene, const Camera& camera, std::uint32_t width,
                 std::uint32_t height, int samples) {
  const View view = make_view(camera, width, height, 1.0);
  const std::vector<glm::dvec2> pattern = raytrace::sample_pattern(samples);
  Image image{width, height, {}};
  for (const char* name : {"R", "G", "B", "A"})
    image.channels.push_back(
        {name, ChannelType::Float, std::vector<float>(std::size_t{width} * height, 1.0F)});
  tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      glm::dvec3 sum(0.0);
      for (const glm::dvec2& place : pattern) {
        const glm::dvec3 ray = ray_through(view, glm::dvec2(x, height - 1 - y) + place);
        if (const auto p = meet(scene, camera.eye, ray)) sum += colour_at(scene, *p);
      }
      const glm::dvec3 mean = sum / static_cast<double>(pattern.size());
      for (glm::length_t c = 0; c < 3; ++c)
        image.channels[static_cast<std::size_t>(c)].values[std::size_t{y} * width + x] =
            static_cast<float>(mean[c]);
    }
  });
  return image;
}

}  // namespace relief::experiment

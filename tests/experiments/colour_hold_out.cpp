// How well colours between the points of a scan are told: every tenth point is left out of the
// conversion, and its colour compared with that of the patches there.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <glm/matrix.hpp>
#include <optional>

#include "common/image/srgb.h"
#include "preprocess/convert.h"
#include "preprocess/readers/read_points.h"

namespace relief::experiment {
namespace {

glm::dvec3 linear(glm::u8vec3 c) {
  const auto of = [](std::uint8_t v) { return linear_from_srgb(static_cast<float>(v) / 255.0F); };
  return {of(c.r), of(c.g), of(c.b)};
}

/// The colour of a patch at a place, bilinear in linear light as it is drawn; nothing where the
/// patch has no surface within half a spacing.
std::optional<glm::dvec3> colour_at(const Patch& patch, glm::dvec3 place) {
  const glm::dvec3 local = glm::transpose(patch.axes) * (place - patch.origin);
  const glm::dvec2 at = glm::dvec2(local) / patch.spacing;
  if (at.x < 0.0 || at.y < 0.0 || at.x >= patch.width - 1 || at.y >= patch.height - 1) return {};
  const auto i = static_cast<std::uint32_t>(at.x);
  const auto j = static_cast<std::uint32_t>(at.y);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::int32_t height = patch.at(i + k % 2, j + k / 2);
    if (height == kHole) return {};
    if (std::abs(height * patch.height_step - local.z) > 2.0 * patch.spacing) return {};
  }
  const glm::dvec2 texel = at * static_cast<double>(patch.colours.scale);
  const glm::dvec2 first = glm::floor(texel);
  const glm::dvec2 share = texel - first;
  const std::size_t index =
      static_cast<std::size_t>(first.y) * patch.colours.width + static_cast<std::size_t>(first.x);
  const auto& texels = patch.colours.texels;
  const auto row = [&](std::size_t k) {
    return glm::mix(linear(texels[k]), linear(texels[k + 1]), share.x);
  };
  return glm::mix(row(index), row(index + patch.colours.width), share.y);
}

int run(const char* file) {
  Progress progress;
  const auto scan = read_points(file, progress);
  const Points* const read = scan ? &scan->points : nullptr;
  if (read == nullptr || read->colours.empty()) {
    fmt::print(stderr, "{}: is no scan with colours\n", file);
    return 1;
  }
  Points kept;
  std::vector<std::size_t> left_out;
  for (std::size_t k = 0; k < read->size(); ++k) {
    if (k % 10 == 0) {
      left_out.push_back(k);
      continue;
    }
    kept.positions.push_back(read->positions[k]);
    kept.colours.push_back(read->colours[k]);
    if (!read->normals.empty()) kept.normals.push_back(read->normals[k]);
  }
  const auto converted = convert(std::move(kept), {}, progress);
  if (!converted) {
    fmt::print(stderr, "{}\n", converted.error().message);
    return 1;
  }
  double sum = 0.0;
  std::size_t count = 0;
  for (const std::size_t k : left_out) {
    for (const Patch& patch : converted->model.patches) {
      const auto colour = colour_at(patch, read->positions[k]);
      if (!colour) continue;
      for (glm::length_t c = 0; c < 3; ++c) {
        const double error =
            srgb8_from_linear(static_cast<float>((*colour)[c])) - read->colours[k][c];
        sum += error * error;
      }
      ++count;
      break;
    }
  }
  const double mean = sum / (3.0 * static_cast<double>(count));
  fmt::print("{}: {} of {} points left out are on patches, colours {:.2f} dB\n", file, count,
             left_out.size(), 20.0 * std::log10(255.0) - 10.0 * std::log10(mean));
  return 0;
}

}  // namespace
}  // namespace relief::experiment

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: colour_hold_out SCAN\n", stderr);
    return 2;
  }
  return relief::experiment::run(argv[1]);
}

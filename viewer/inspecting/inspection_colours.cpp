#include "viewer/inspecting/inspection_colours.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "common/image/srgb.h"
#include "renderer/geometry/cells/levels.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr auto kColours = static_cast<std::uint32_t>(shared::kInspectionColours);

/// Linear sRGB of OKLCH (Ottosson, "A perceptual color space for image processing", 2020).
glm::dvec3 linear_from_oklch(double lightness, double chroma, double hue) {
  const double a = chroma * std::cos(hue);
  const double b = chroma * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

}  // namespace

glm::u8vec3 patch_colour(std::uint32_t id) {
  // Of the steps of hue and lightness that were tried those whose colours differ most from the next
  // three. 61 has no common factor with 256: no hue comes twice.
  constexpr std::array<double, 2> kLightness{0.65, 0.85};
  constexpr std::array<double, 2> kChroma{0.16, 0.1};
  constexpr double kHueStep = 61.0 * 2.0 * std::numbers::pi / kColours;
  const std::uint32_t k = id % kColours;
  const glm::dvec3 linear =
      linear_from_oklch(kLightness[k % 2], kChroma[k % 2], kHueStep * double(k));
  const auto encoded = [](double x) {
    return static_cast<std::uint8_t>(std::lround(255.0F * srgb_from_linear(static_cast<float>(x))));
  };
  return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

glm::u8vec3 level_colour(std::uint32_t level) {
  return colour_at(ColourMap::Viridis, 1.0 - double(level) / double(kMaxLevels - 1));
}

std::vector<glm::u8vec3> colours_of(Inspection inspection) {
  std::vector<glm::u8vec3> colours(kColours, kAfarColour);
  for (std::uint32_t k = 0; k < kColours; ++k) {
    const double share = double(k) / double(kColours - 1);
    if (inspection == Inspection::Patches) colours[k] = patch_colour(k);
    if (inspection == Inspection::Levels && k < kMaxLevels) colours[k] = level_colour(k);
    if (inspection == Inspection::Overdraw) colours[k] = colour_at(kFragmentMap, share);
  }
  return colours;
}

}  // namespace relief

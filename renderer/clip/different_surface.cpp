#include "renderer/clip/different_surface.h"

#include <cmath>
#include <numbers>

namespace relief {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kDefaultAngle = 30.0 * kDegree;
constexpr double kWallAngle = 10.0 * kDegree;

}  // namespace

SurfaceTest surface_test(const DiscTree& /*tree*/, const ClipSettings& settings) {
  return {settings.threshold.value_or(std::cos(kDefaultAngle)), std::sin(kWallAngle)};
}

}  // namespace relief

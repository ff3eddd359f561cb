#include "preprocess/readers/pcd/sensor_stance.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "common/bounds.h"

namespace relief {
namespace {

/// Cameras with depth see 30 to 60 degrees off their line of sight, fused scans a little more.
constexpr double kMostSlope = 3.73;  // tan 75 degrees

/// Stray points may be anywhere.
constexpr double kMostOutside = 0.01;

/// How the points stand if they are before a sensor in that pose; nothing if they are not.
std::optional<Stance> stance_before(const std::vector<glm::dvec3>& positions,
                                    const SensorPose& pose) {
  const glm::dquat to_sensor = glm::conjugate(pose.turn);
  std::size_t count = 0;
  std::size_t outside = 0;
  Bounds seen;  // where the lines of sight meet the plane at distance 1
  for (const glm::dvec3& position : positions) {
    const glm::dvec3 p = to_sensor * (position - pose.position);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
    ++count;
    if (p.z > 0.0 && std::hypot(p.x, p.y) < kMostSlope * p.z) {
      extend(seen, {p.x / p.z, p.y / p.z, 1.0});
    } else {
      ++outside;
    }
  }
  if (count == 0 || static_cast<double>(outside) > kMostOutside * static_cast<double>(count))
    return std::nullopt;
  Stance stance;
  stance.up = pose.turn * glm::dvec3(0.0, -1.0, 0.0);
  stance.front = pose.turn * glm::dvec3(0.0, 0.0, -1.0);
  // One image is about the line of sight; a map in the first image's frame is anywhere.
  stance.is_from_sensor =
      seen.min.x < 0.0 && seen.max.x > 0.0 && seen.min.y < 0.0 && seen.max.y > 0.0;
  return stance;
}

}  // namespace

Stance sensor_stance(const std::vector<glm::dvec3>& positions, const SensorPose& pose) {
  if (const auto stance = stance_before(positions, pose)) return *stance;
  // Drivers write points in the sensor's own frame, and a pose that turns them upright.
  return stance_before(positions, {}).value_or(kZUp);
}

}  // namespace relief

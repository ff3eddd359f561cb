// Poses of range scans: the .conf files of the Stanford 3D Scanning Repository.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// One scan: a point p of its file is at turn * p + translation in the world.
struct ScanPose {
  std::string file;  ///< as the .conf file names it
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 translation{0.0};
};

/// More scans than any object has; limits what a hostile file can request.
inline constexpr std::size_t kMaxScans = 1000;

/// Reads lines `bmesh FILE tx ty tz qx qy qz qw`. Skips other lines, such as `camera` and `mesh`,
/// blank lines and comments (#). As usual in these files, the quaternion is that of the inverse
/// rotation. Errors begin with `name`.
Result<std::vector<ScanPose>> read_scan_poses(const std::string& name, std::string_view text);

/// Returns the path of a scan of a .conf file: beside it (see resolve_beside), plain or with ".gz".
/// Only PLY files are accepted, so that no .conf refers to another.
Result<std::filesystem::path> find_scan(const std::filesystem::path& conf, const ScanPose& pose);

/// Transforms a scan into the world.
void place_scan(const ScanPose& pose, Points& scan);

}  // namespace relief

// Range scans and where they stand: the .conf files of the Stanford 3D Scanning Repository.
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

/// One scan: p of its file is at turn * p + place in the world.
struct ScanPose {
  std::string file;  ///< as the .conf file names it
  glm::dquat turn{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 place{0.0};
};

/// More scans than any object has; bounds what a hostile file asks for.
inline constexpr std::size_t kMostScans = 1000;

/// Reads lines `bmesh FILE tx ty tz qx qy qz qw`; `camera` and `mesh` lines that are none of a
/// scan, blank ones and comments (#) are passed over. The quaternion is that of the way back, as
/// these files have it. `name` begins errors.
Result<std::vector<ScanPose>> read_scan_poses(const std::string& name, std::string_view text);

/// Where the scan of a .conf file lies: beside it (see resolve_beside), as it is or with ".gz".
/// Only PLY files are taken, so that no .conf leads to another.
Result<std::filesystem::path> find_scan(const std::filesystem::path& conf, const ScanPose& pose);

/// Turns and moves a scan into the world.
void place_scan(const ScanPose& pose, Points& scan);

}  // namespace relief

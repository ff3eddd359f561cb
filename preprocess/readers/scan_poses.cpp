#include "preprocess/readers/scan_poses.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/texture/files/load_textures.h"

namespace relief {

Result<std::vector<ScanPose>> read_scan_poses(const std::string& name, std::string_view text) {
  std::vector<ScanPose> poses;
  TextCursor line(text, TextCursor::kBlanks, '#');
  while (line.next_line()) {
    if (line.peek() != "bmesh") continue;
    (void)line.word();
    ScanPose pose;
    pose.file = std::string(line.word());
    double q[4] = {};
    bool good = !pose.file.empty();
    for (glm::length_t c = 0; c < 3; ++c) good = good && line.number(pose.translation[c]);
    for (double& part : q) good = good && line.number(part);
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    // Written with six digits: numbers with a length off by a hundredth are not a rotation.
    if (!good || !(std::abs(length - 1.0) < 0.01) ||
        !std::isfinite(glm::length(pose.translation))) {
      return make_error(
          "{}: line {}: expected bmesh FILE, a translation of three numbers and a quaternion of "
          "length 1",
          name, line.line_number());
    }
    pose.turn = glm::conjugate(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    poses.push_back(std::move(pose));
    if (poses.size() > kMaxScans)
      return make_error("{}: names more than {} scans", name, kMaxScans);
  }
  if (poses.empty()) return make_error("{}: names no scan (bmesh FILE ...)", name);
  return poses;
}

Result<std::filesystem::path> find_scan(const std::filesystem::path& conf, const ScanPose& pose) {
  const std::filesystem::path path = resolve_beside(conf, pose.file);
  const std::string ending = lower_case(path.extension().string());
  if (ending != ".ply") {
    return make_error("{}: names {}, which is not a PLY file", conf.string(),
                      relief::quoted(pose.file));
  }
  std::error_code ignored;
  std::filesystem::path packed = path;
  packed += ".gz";
  const bool is_packed =
      !std::filesystem::exists(path, ignored) && std::filesystem::exists(packed, ignored);
  return is_packed ? packed : path;
}

void place_scan(const ScanPose& pose, Points& scan) {
  for (glm::dvec3& p : scan.positions) p = pose.turn * p + pose.translation;
  for (glm::vec3& n : scan.normals) n = glm::vec3(pose.turn * glm::dvec3(n));
  for (CornerTangents& corners : scan.corner_tangents) {
    for (glm::vec4& t : corners) t = glm::vec4(glm::vec3(pose.turn * glm::dvec3(t)), t.w);
  }
  for (glm::dvec3& p : scan.scanners) p = pose.turn * p + pose.translation;
  if (scan.viewpoint) scan.viewpoint = pose.turn * *scan.viewpoint + pose.translation;
}

}  // namespace relief

#include <fmt/format.h>

#include "common/export/export.h"
#include "common/export/export_file.h"
#include "common/version.h"

namespace relief {
namespace {

std::string header_of(const Points& points, bool doubles) {
  const std::string_view real = doubles ? "double" : "float";
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by relief {}\nelement vertex {}\n"
      "property {} x\nproperty {} y\nproperty {} z\n",
      kVersion, points.size(), real, real, real);
  if (!points.normals.empty())
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!points.colours.empty())
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!points.triangles.empty()) {
    // Readers without unsigned indices are more common than scans beyond 2^31 points.
    header += fmt::format("element face {}\nproperty list uchar {} vertex_indices\n",
                          points.triangles.size(), points.size() > INT32_MAX ? "uint" : "int");
  }
  return header + "end_header\n";
}

}  // namespace

Status export_ply(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress) {
  const Points& points = request.points;
  auto file = ExportFile::create(path, points.size() + points.triangles.size(), progress);
  if (!file) return file.error();
  const bool doubles = needs_doubles(points, request.tolerance);
  file->text(header_of(points, doubles));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const glm::dvec3 p = points.positions[k];
    if (doubles) {
      file->numbers(p.x, p.y, p.z);
    } else {
      file->numbers(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
    }
    if (!points.normals.empty()) {
      const glm::vec3 n = points.normals[k];
      file->numbers(n.x, n.y, n.z);
    }
    if (!points.colours.empty()) {
      const glm::u8vec3 c = points.colours[k];
      file->numbers(c.r, c.g, c.b);
    }
    if (!file->end_record()) break;
  }
  for (const Triangle& t : points.triangles) {
    file->numbers(std::uint8_t{3}, t[0], t[1], t[2]);
    if (!file->end_record()) break;
  }
  return file->finish();
}

}  // namespace relief

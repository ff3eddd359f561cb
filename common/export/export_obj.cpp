#include <fmt/format.h>

#include "common/export/export.h"
#include "common/export/export_file.h"
#include "common/version.h"

namespace relief {

Status export_obj(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress) {
  const Points& points = request.points;
  auto file = ExportFile::create(
      path, points.size() + points.normals.size() + points.triangles.size(), progress);
  if (!file) return file.error();
  file->text(fmt::format("# made by relief {}\n", kVersion));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const glm::dvec3 p = points.positions[k];
    file->text(fmt::format("v {} {} {}", p.x, p.y, p.z));
    if (!points.colours.empty()) {
      // Three decimals distinguish 256 values.
      const glm::vec3 c = glm::vec3(points.colours[k]) / 255.0F;
      file->text(fmt::format(" {:.3f} {:.3f} {:.3f}", c.r, c.g, c.b));
    }
    file->text("\n");
    if (!file->end_record()) break;
  }
  for (const glm::vec3 n : points.normals) {
    file->text(fmt::format("vn {:.6f} {:.6f} {:.6f}\n", n.x, n.y, n.z));
    if (!file->end_record()) break;
  }
  for (const Triangle& t : points.triangles) {
    // OBJ counts from 1.
    const std::uint64_t a = t[0] + std::uint64_t{1};
    const std::uint64_t b = t[1] + std::uint64_t{1};
    const std::uint64_t c = t[2] + std::uint64_t{1};
    file->text(points.normals.empty() ? fmt::format("f {} {} {}\n", a, b, c)
                                      : fmt::format("f {}//{} {}//{} {}//{}\n", a, a, b, b, c, c));
    if (!file->end_record()) break;
  }
  return file->finish();
}

}  // namespace relief

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "common/export/export.h"
#include "common/export/export_file.h"
#include "common/scalars/quantise.h"
#include "common/version.h"

namespace relief {
namespace {

enum class ScalarType { Label, Single, Double };

/// Labels as whole numbers if each point has one. Doubles where the range is so narrow beside its
/// numbers, as for times, that single precision has fewer steps than a patch file.
ScalarType type_of(const PointScalar& scalar) {
  const bool is_whole =
      std::ranges::none_of(scalar.values, [](double value) { return std::isnan(value); });
  if (scalar.is_label && is_whole) return ScalarType::Label;
  const auto quantiles = find_quantiles(scalar.values);
  if (!quantiles) return ScalarType::Single;
  const double largest = std::max(std::abs(quantiles->front()), std::abs(quantiles->back()));
  const double width = quantiles->back() - quantiles->front();
  return largest * std::numeric_limits<float>::epsilon() > width / kMaxScalarCode
             ? ScalarType::Double
             : ScalarType::Single;
}

constexpr std::string_view name_of(ScalarType type) {
  if (type == ScalarType::Label) return "ushort";
  return type == ScalarType::Double ? "double" : "float";
}

void write_scalar(ExportFile& file, ScalarType type, double value) {
  if (type == ScalarType::Label) {
    file.numbers(static_cast<std::uint16_t>(value));
  } else if (type == ScalarType::Double) {
    file.numbers(value);
  } else {
    file.numbers(static_cast<float>(value));
  }
}

std::string header_of(const Points& points, bool doubles, std::span<const ScalarType> scalars) {
  const std::string_view real = doubles ? "double" : "float";
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment made by relief {}\nelement vertex {}\n"
      "property {} x\nproperty {} y\nproperty {} z\n",
      kVersion, points.size(), real, real, real);
  if (!points.normals.empty())
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!points.colours.empty())
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  for (std::size_t k = 0; k < scalars.size(); ++k)
    header += fmt::format("property {} {}\n", name_of(scalars[k]), points.scalars[k].name);
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
  std::vector<ScalarType> scalars;
  for (const PointScalar& scalar : points.scalars) scalars.push_back(type_of(scalar));
  file->text(header_of(points, doubles, scalars));
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
    for (std::size_t s = 0; s < scalars.size(); ++s)
      write_scalar(*file, scalars[s], points.scalars[s].values[k]);
    if (!file->end_record()) break;
  }
  for (const Triangle& t : points.triangles) {
    file->numbers(std::uint8_t{3}, t[0], t[1], t[2]);
    if (!file->end_record()) break;
  }
  return file->finish();
}

}  // namespace relief

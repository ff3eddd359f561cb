// Points as a file, for what reads scans block by block.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "common/points.h"
#include "tests/common/patch_file/sample_models.h"

namespace relief::test {

inline void write_ply(const std::filesystem::path& path, const Points& points) {
  std::string scalars;
  for (const PointScalar& scalar : points.scalars)
    scalars += fmt::format("property double {}\n", scalar.name);
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double "
      "y\nproperty double z\n{}{}{}end_header\n",
      points.size(),
      points.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
      points.colours.empty() ? ""
                             : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      scalars);
  const auto append = [&](const auto& value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    append(points.positions[i]);
    if (!points.normals.empty()) append(points.normals[i]);
    if (!points.colours.empty()) append(points.colours[i]);
    for (const PointScalar& scalar : points.scalars) append(scalar.values[i]);
  }
  spill(path, text);
}

}  // namespace relief::test

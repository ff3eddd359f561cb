// Measurements as files, in full double precision: every number reads back as the very same.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "common/error.h"
#include "viewer/measuring/measurement.h"

namespace relief {

/// What measurements were made of.
struct MeasurementSource {
  std::string file;              ///< as the user names it; UTF-8
  glm::dvec3 up{0.0, 1.0, 0.0};  ///< as in values_of()
};

/// Returns a JSON object {"version": 1, "file", "up", "measurements": [{"name", "kind", values by
/// name, "points": [{"position", "normal", "colour", "patch", "uv"}]}]}. Colours are sRGB, 0 to
/// 255, or null. Incomplete measurements are left out. `name` is of UTF-8, or what is not becomes
/// U+FFFD.
[[nodiscard]] std::string measurements_as_json(std::span<const Measurement> measurements,
                                               const MeasurementSource& model);

/// Returns a table with a header and a row per point (RFC 4180, lines end in \n): number and name
/// of the measurement, kind, number of the point, x, y, z, normal, colour, patch, and in the row of
/// the first point what was measured. Fields that do not apply are empty.
[[nodiscard]] std::string measurements_as_csv(std::span<const Measurement> measurements,
                                              const MeasurementSource& model);

/// Writes a .json or a .csv file, atomically. Fails at any other extension and as
/// write_file_atomically() does.
Status write_measurements(const std::filesystem::path& path,
                          std::span<const Measurement> measurements,
                          const MeasurementSource& model);

}  // namespace relief

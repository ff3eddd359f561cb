// Reads the header of PCD files.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/readers/number_type.h"
#include "preprocess/readers/pcd/sensor_stance.h"
#include "preprocess/readers/source.h"

namespace relief {

struct PcdField {
  std::string name;  ///< in lower case
  NumberType type = NumberType::Float32;
  std::uint64_t count = 1;   ///< numbers per point
  std::uint64_t offset = 0;  ///< bytes from the start of a point
};

enum class PcdEncoding { Ascii, Binary, Compressed };

struct PcdHeader {
  PcdEncoding encoding = PcdEncoding::Ascii;
  std::vector<PcdField> fields;
  std::uint64_t stride = 0;  ///< bytes per point
  std::uint64_t points = 0;
  /// Unless it is the default, which means nothing unless the points are a camera's rows and
  /// columns.
  std::optional<glm::dvec3> viewpoint;
  SensorPose pose;
  std::size_t body = 0;  ///< offset of the first byte after the header
};

/// Reads the header. The number of points is not yet checked against the body.
Result<PcdHeader> read_pcd_header(const Source& source);

}  // namespace relief

// Reads the header of LAS files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "preprocess/readers/source.h"

namespace relief {

/// A point's position is offset + scale * (its three integers).
struct LasHeader {
  std::uint32_t format = 0;  ///< point record format, 0 to 10
  bool is_packed = false;    ///< LAZ, or COPC, which is LAZ too
  std::size_t body = 0;      ///< byte of the first point
  std::size_t stride = 0;    ///< bytes per point, extra bytes included
  std::uint64_t points = 0;
  glm::dvec3 scale{1.0};
  glm::dvec3 offset{0.0};

  /// Formats 6 to 10 have separate bytes for flags and classes.
  [[nodiscard]] bool is_wide() const { return format >= 6; }
  /// Bytes of a point without extra bytes.
  [[nodiscard]] std::size_t standard_bytes() const;
  /// Offset of a point's GPS time; 0: none.
  [[nodiscard]] std::size_t time_at() const;
  /// Offset of a point's red, green and blue; 0: no colours.
  [[nodiscard]] std::size_t colour_at() const;
};

/// Reads and checks the header (LAS 1.1 to 1.4, ASPRS). Variable length records must fit into the
/// file, and all points, unless they are packed.
Result<LasHeader> read_las_header(const Source& source);

}  // namespace relief

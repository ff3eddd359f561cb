// One point of a LAS or LAZ file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <memory>

#include "common/error.h"
#include "preprocess/readers/las/las_header.h"
#include "preprocess/readers/source.h"

namespace relief {

/// A decoded point, the same for plain and packed files. A further field of the format becomes a
/// member here, and a line in read_las_point (las_point.cpp) and in PackedReader (laz.cpp).
struct LasPoint {
  glm::i32vec3 steps{0};   ///< position as integers, see LasHeader
  glm::u16vec3 colour{0};  ///< only if LasHeader::colour_at()
  std::uint8_t point_class = 0;
  std::uint8_t return_number = 1;  ///< 1 is the first
  std::uint8_t returns = 1;        ///< of its pulse; both are 1 in files that leave them 0
  bool is_withheld = false;
};

/// Decodes a point record. It must have the header's size.
[[nodiscard]] LasPoint read_las_point(const char* record, const LasHeader& header);

/// The points of a file, one after another.
class LasPointReader {
 public:
  LasPointReader() = default;
  virtual ~LasPointReader() = default;
  LasPointReader(const LasPointReader&) = delete;
  LasPointReader& operator=(const LasPointReader&) = delete;

  /// Reads the next point. Called at most LasHeader::points times.
  virtual Status next(LasPoint& point) = 0;
  /// Returns the offset in the file up to which bytes have been read.
  [[nodiscard]] virtual std::size_t offset() const = 0;
};

using LasPoints = std::unique_ptr<LasPointReader>;

/// Begins at the first point of a plain file.
[[nodiscard]] LasPoints open_las_points(const Source& source, const LasHeader& header);

/// Begins at the first point of a packed file (LAZ). Fails with one sentence, and always in a build
/// without LASzip. The header must have been checked.
Result<LasPoints> open_laz_points(const Source& source, const LasHeader& header);

/// Returns whether this build has LASzip.
[[nodiscard]] bool can_unpack_laz();

}  // namespace relief

// The points of a LAS or LAZ file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <memory>

#include "common/error.h"
#include "preprocess/readers/las/las_header.h"
#include "preprocess/readers/source.h"

namespace relief {

/// A decoded point: what every reading needs of its record.
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

/// The point records of a file, one after another, as a plain file has them: packed files are
/// unpacked to such records (LAS 1.4 R15, tables 7 to 17).
class LasRecordReader {
 public:
  LasRecordReader() = default;
  virtual ~LasRecordReader() = default;
  LasRecordReader(const LasRecordReader&) = delete;
  LasRecordReader& operator=(const LasRecordReader&) = delete;

  /// Returns the next record, LasHeader::stride bytes that are valid until the next call. Called at
  /// most LasHeader::points times.
  virtual Result<const char*> next() = 0;
  /// Returns the offset in the file up to which bytes have been read.
  [[nodiscard]] virtual std::size_t offset() const = 0;
};

using LasRecords = std::unique_ptr<LasRecordReader>;

/// Begins at the first point of a plain file.
[[nodiscard]] LasRecords open_las_records(const Source& source, const LasHeader& header);

/// Begins at the first point of a packed file (LAZ). Fails with one sentence, and always in a build
/// without LASzip. The header must have been checked.
Result<LasRecords> open_laz_records(const Source& source, const LasHeader& header);

/// Returns whether this build has LASzip.
[[nodiscard]] bool can_unpack_laz();

}  // namespace relief

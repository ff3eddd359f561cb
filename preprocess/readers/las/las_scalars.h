// The scalars of LAS points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/readers/las/las_header.h"
#include "preprocess/readers/number_type.h"

namespace relief {

/// A scalar of a point record.
struct LasScalar {
  std::string name;    ///< canonical
  std::size_t at = 0;  ///< byte within the record
  NumberType type = NumberType::Uint8;
  unsigned shift = 0;      ///< bits to the right of it
  std::uint32_t mask = 0;  ///< the bits that are it; 0: all
  double scale = 1.0;
  double offset = 0.0;
  std::optional<double> no_data = {};  ///< stored number that stands for none

  /// Returns the scalar of a record; NaN if the file has none.
  [[nodiscard]] double of(const char* record) const;
};

/// Finds the scalars that the source takes: intensity, return_number, number_of_returns,
/// classification, scan_angle (degrees), user_data, point_source_id, gps_time, and the extra bytes
/// that a record of the file describes (LAS 1.4 R15, table 24). Descriptions that do not fit into a
/// point record are ignored.
[[nodiscard]] std::vector<LasScalar> find_las_scalars(const Source& source,
                                                      const LasHeader& header);

}  // namespace relief

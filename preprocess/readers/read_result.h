// The result of reading a scan.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/points.h"

namespace relief {

/// The points of a file, and counts of those left out.
struct ReadResult {
  Points points;
  std::uint64_t points_in_file = 0;
  std::uint64_t dropped_nonfinite = 0;  ///< NaN or infinite coordinates
  std::uint64_t left_out = 0;           ///< marked in the file as withheld or noise (LAS)
  std::uint64_t not_selected = 0;       ///< of other classes, other returns or outside of the crop
  std::uint64_t merged_duplicates = 0;  ///< same position as an earlier point
  std::vector<std::string> notes;       ///< for the user, a sentence each
};

}  // namespace relief

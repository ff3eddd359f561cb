// The files of one scan, read block by block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// What was read of a scan's files, and what was left out.
struct ScanCounts {
  std::uint64_t points = 0;     ///< that are finite; duplicates among them
  std::uint64_t nonfinite = 0;  ///< dropped
  std::uint64_t left_out = 0;   ///< marked in a file as withheld or noise (LAS)
};

/// Takes the next points.
using TakePoints = std::function<Status(Points block)>;

/// Reads files one after another and hands their points on, in their order, all of them finite. Of
/// formats that stream (see readers/format.h) only a block is in memory at a time; others are read
/// as a whole, and refused if that is likely to take more than `memory` bytes. Packed files are
/// unpacked to `folder` first, where a later call finds them. Triangles are left out. `notes` gets
/// what the user should hear of.
Result<ScanCounts> read_blocks(const std::vector<std::filesystem::path>& files,
                               const std::filesystem::path& folder, std::uint64_t memory,
                               const TakePoints& take, std::vector<std::string>& notes,
                               Progress& progress);

}  // namespace relief

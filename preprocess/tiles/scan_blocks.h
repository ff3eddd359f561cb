// Reads the files of one scan block by block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/readers/selection.h"

namespace relief {

/// Counts of the points of a scan's files.
struct ScanCounts {
  std::uint64_t points = 0;        ///< finite ones, duplicates included
  std::uint64_t nonfinite = 0;     ///< dropped
  std::uint64_t left_out = 0;      ///< marked in a file as withheld or noise (LAS)
  std::uint64_t not_selected = 0;  ///< by ReadOptions::selection
};

/// Receives the next points.
using TakePoints = std::function<Status(Points block)>;

/// Reads files one after another and passes their points on, in their order, without NaN and
/// infinite points. Of formats that stream (see readers/format.h) only a block is in memory at a
/// time; others are read as a whole, and refused if that is likely to take more than `memory`
/// bytes. Packed files are first unpacked to `folder`, where a later call finds them. Triangles are
/// left out. Scalars are finite or NaN; fails if a file lacks one that `options` name. Adds notes
/// for the user to `notes`.
Result<ScanCounts> read_blocks(const std::vector<std::filesystem::path>& files,
                               const std::filesystem::path& folder, const ReadOptions& options,
                               std::uint64_t memory, const TakePoints& take,
                               std::vector<std::string>& notes, Progress& progress);

}  // namespace relief

// Reads point scans and meshes from files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// The points of a file, and counts of those left out.
struct ReadResult {
  Points points;
  std::uint64_t points_in_file = 0;
  std::uint64_t dropped_nonfinite = 0;  ///< NaN or infinite coordinates
  std::uint64_t left_out = 0;           ///< marked in the file as withheld or noise (LAS)
  std::uint64_t merged_duplicates = 0;  ///< same position as an earlier point
  std::vector<std::string> notes;       ///< for the user, a sentence each
};

/// Reads and cleans a file of any readable format (see readers.h), plain or gzipped. The format
/// follows from the content, or from the extension if the content does not show it. Drops points
/// with NaN or infinite coordinates. Merges points at equal positions: averages their normals and
/// keeps the first colour and texture coordinate; triangles keep texture seams. Renumbers triangles
/// and drops degenerate ones. The file is not trusted: every count is checked against the remaining
/// bytes before memory is allocated for it. Fails with one sentence: file, line or byte, what was
/// expected.
Result<ReadResult> read_points(const std::filesystem::path& path, Progress& progress);

/// Returns the names of all readable formats, for messages: "PLY, PCD, ... and XYZ text".
[[nodiscard]] std::string readable_formats();

/// Returns the names of the formats that are read in blocks, so that a scan may exceed memory.
[[nodiscard]] std::string streamed_formats();

/// Drops NaN and infinite points and merges duplicates, as read_points does, for points of other
/// origin. `number`, if given, receives each point's new index, UINT32_MAX for dropped points.
ReadResult clean_points(Points points, std::vector<std::uint32_t>* number = nullptr);

}  // namespace relief

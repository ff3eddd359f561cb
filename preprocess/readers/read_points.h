// Point scans and meshes from files of the field's formats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// What was read, and what was left out on the way.
struct ReadResult {
  Points points;
  std::uint64_t points_in_file = 0;
  std::uint64_t dropped_nonfinite = 0;  ///< NaN or infinite coordinates
  std::uint64_t left_out = 0;           ///< marked in the file as withheld or noise (LAS)
  std::uint64_t merged_duplicates = 0;  ///< same position as an earlier point
  std::vector<std::string> notes;       ///< what the user should hear of, a sentence each
};

/// Reads PLY (ASCII, little- and big-endian), PCD (ascii, binary, binary_compressed), LAS, PTX,
/// OBJ, glTF, Draco, OFF, STL (ASCII, binary) or XYZ text, each also gzipped. The format is told
/// from the first bytes where they tell it, otherwise from the name. Points with non-finite
/// coordinates are dropped, points at the same position merged (their normals averaged, the first
/// colour and texture coordinate kept; triangles keep texture seams), triangles renumbered,
/// degenerate triangles dropped. The file is not trusted: every count is checked against the bytes
/// that are left before anything is allocated for it. Fails with one sentence: file, line or byte,
/// what was expected.
Result<ReadResult> read_points(const std::filesystem::path& path, Progress& progress);

/// The names of all formats that can be read, for messages: "PLY, PCD, ... and XYZ text".
[[nodiscard]] std::string readable_formats();

/// Those of the formats that are read in blocks, so that a scan may be larger than memory.
[[nodiscard]] std::string streamed_formats();

/// Drops non-finite points and merges duplicates, as read_points does; for points made elsewhere.
/// `number`, if given, gets each point's place among those that are left, UINT32_MAX if it was
/// dropped.
ReadResult clean_points(Points points, std::vector<std::uint32_t>* number = nullptr);

}  // namespace relief

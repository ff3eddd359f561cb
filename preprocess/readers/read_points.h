// Reads point scans and meshes from files.
#pragma once

#include <filesystem>
#include <string>

#include "common/error.h"
#include "common/progress.h"
#include "common/scalars/scalar_names.h"
#include "preprocess/readers/read_result.h"
#include "preprocess/readers/selection.h"

namespace relief {

/// Reads and cleans a file of any readable format (see readers.h), plain or gzipped. The format
/// follows from the content, or from the extension if the content does not show it. Drops points
/// with NaN or infinite coordinates. Merges points at equal positions: averages their normals and
/// keeps the first colour and texture coordinate; triangles keep texture seams. Renumbers triangles
/// and drops degenerate and repeated ones. The file is not trusted: every count is checked against
/// the remaining bytes before memory is allocated for it. Fails with one sentence: file, line or
/// byte, what was expected. Fails if the options select no point, or classes of a format without
/// them, or name a scalar that the file lacks. With `all`, a scalar without any finite number is
/// left out.
Result<ReadResult> read_points(const std::filesystem::path& path, Progress& progress,
                               const ReadOptions& options = {});

/// Returns the names of all readable formats, for messages: "PLY, PCD, ... and XYZ text".
[[nodiscard]] std::string readable_formats();

/// Returns the names of the formats that are read in blocks, so that a scan may exceed memory.
[[nodiscard]] std::string streamed_formats();

/// Drops NaN and infinite points and merges duplicates, as read_points does, for points of other
/// origin. `number`, if given, receives each point's new index, UINT32_MAX for dropped points.
ReadResult clean_points(Points points, std::vector<std::uint32_t>* number = nullptr);

}  // namespace relief

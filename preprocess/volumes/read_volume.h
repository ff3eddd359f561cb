// Reads volumes: scalar fields at the nodes of a grid.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "common/error.h"
#include "common/progress.h"
#include "common/volume/scalar_volume.h"
#include "preprocess/volumes/raw_layout.h"

namespace relief {

struct VolumeReadOptions {
  std::optional<RawLayout> raw;  ///< the file has no header, and this layout
  /// The file is a scan whose points are the nodes, and this scalar their value (its canonical
  /// name). read_volume() does not read it: see volume_of_points() in points/point_volume.h.
  std::optional<std::string> scalar;
};

/// Returns whether a file is read as a volume: by its extension, or because it has a raw layout.
[[nodiscard]] bool is_volume(const std::filesystem::path& path, const VolumeReadOptions& options);

/// Returns the extensions of all formats, for messages: ".nrrd, .nhdr, ... and .vts".
[[nodiscard]] std::string volume_extensions();

/// Reads a volume (see volume_readers.h for the formats): values as floats, so that 32-bit integers
/// above 2^24 are rounded; infinities become NaN, which is no value. Medical files (NRRD with an
/// anatomical space, NIfTI with an sform or qform, MetaImage) come in right-anterior-superior
/// coordinates and face the viewer, with +Z up and +Y in front. All others keep their coordinates
/// and have +Z up and -Y in front. Units are the file's. The file is not trusted: every count is
/// checked against the remaining bytes before memory is allocated for it. Fails with one sentence:
/// file, what was found, what to do; also if no node has a value.
Result<ScalarVolume> read_volume(const std::filesystem::path& path,
                                 const VolumeReadOptions& options, Progress& progress);

/// Reads a file in memory as read_volume does. `path` gives the format and the folder of a detached
/// file of values, and begins errors.
Result<ScalarVolume> read_volume_bytes(const std::filesystem::path& path,
                                       std::span<const std::byte> bytes,
                                       const VolumeReadOptions& options, Progress& progress);

}  // namespace relief

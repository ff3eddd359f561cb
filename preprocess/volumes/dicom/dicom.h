// Reads DICOM: a file of several frames, or the slices of a series.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "common/volume/scalar_volume.h"

namespace relief {

/// Whether a path is a DICOM file, which may have any name, or a folder that holds one.
[[nodiscard]] bool is_dicom(const std::filesystem::path& path);

/// Reads a folder that holds one series, or the series of which a file is a slice, from the folder
/// in which it lies. Slices may have any names. Values are in the unit that the files state;
/// coordinates in mm, right-anterior-superior. Fails with a sentence; always if the build has no
/// GDCM.
Result<ScalarVolume> read_dicom(const std::filesystem::path& path, Progress& progress);

}  // namespace relief

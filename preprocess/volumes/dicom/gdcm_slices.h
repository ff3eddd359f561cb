// DICOM files through GDCM, if the build has it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/volumes/dicom/dicom_slice.h"

namespace relief {

/// What each of some files says: one unit of progress each. A file that is no DICOM, or that GDCM
/// cannot read, has no image. Fails if the build has no GDCM.
Result<std::vector<DicomSlice>> read_dicom_slices(std::span<const std::filesystem::path> files,
                                                  Progress& progress);

/// Appends the values of some files, of `count` pixels each, to `values`: one unit of progress
/// each. In the unit that the files state (rescale slope and intercept). Fails with a sentence.
Status read_dicom_values(std::span<const std::filesystem::path> files, std::size_t count,
                         std::vector<float>& values, Progress& progress);

/// Whether the build has GDCM.
[[nodiscard]] bool can_read_dicom();

}  // namespace relief

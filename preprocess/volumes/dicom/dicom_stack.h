// The slices of a DICOM series as one volume.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/volume/scalar_volume.h"
#include "preprocess/volumes/dicom/dicom_slice.h"

namespace relief {

/// A volume without values yet, and whose they are.
struct DicomStack {
  ScalarVolume volume;
  std::vector<std::size_t> files;  ///< by index, in the order of the values
};

/// Stacks slices by their places. `slices`: of each file. `named`: one of the files, whose series
/// is stacked, or the folder, which must hold but one. A file with several frames is a volume of
/// its own. Right-anterior-superior if the files say where they are. Fails, with a sentence, if the
/// slices make no stack.
Result<DicomStack> stack_slices(std::span<const std::filesystem::path> files,
                                std::span<const DicomSlice> slices,
                                const std::filesystem::path& named);

}  // namespace relief

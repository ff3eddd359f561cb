// Reads the arrays of VTK's XML files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/volumes/vtk/vtk_document.h"

namespace relief {

/// Reads an array that must have `count` numbers: as text, as base64, or from the appended data,
/// raw or base64; compressed by zlib if the document says so. As floats, infinities become NaN.
template <class Real>
Result<std::vector<Real>> read_vtk_array(const VolumeSource& source, const VtkDocument& document,
                                         const VtkArray& array, std::uint64_t count);

extern template Result<std::vector<float>> read_vtk_array(const VolumeSource&, const VtkDocument&,
                                                          const VtkArray&, std::uint64_t);
extern template Result<std::vector<double>> read_vtk_array(const VolumeSource&, const VtkDocument&,
                                                           const VtkArray&, std::uint64_t);

}  // namespace relief

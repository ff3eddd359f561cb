// The Gaussians of .spz files.
#pragma once

#include <cstddef>
#include <span>

#include "common/error.h"
#include "common/volume/gaussian_cloud.h"
#include "preprocess/gaussians/spz_header.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Decodes the streams of a file, decompressed and one behind the other: spz_sizes(header).sum()
/// bytes for each Gaussian.
Result<GaussianCloud> decode_spz(const Source& source, const SpzHeader& header, AxisSigns axes,
                                 std::span<const std::byte> streams);

}  // namespace relief

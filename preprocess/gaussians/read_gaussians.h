// Reads scenes of 3D Gaussians.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "common/volume/gaussian_cloud.h"

namespace relief {

/// Returns whether a file is read as a scene of Gaussians: a .spz file by its extension, a .ply or
/// .ply.gz file by its header, of which at most 1 MiB is read. Points and meshes have other
/// properties. Fails if a .ply file can't be opened; one with a damaged header is no scene.
Result<bool> is_gaussians(const std::filesystem::path& path);

/// Reads a scene of Gaussians (see gaussian_readers.h for the formats) into the frame of
/// GaussianCloud: right-handed, Y up, Z toward the viewer. Gaussians with a number that is NaN or
/// infinite, with a scale of 0 (as a float) or with a quaternion of length 0 are dropped, and one
/// note counts them; the others keep their order. The file is not trusted: every count is checked
/// against the remaining bytes before memory is allocated for it. Fails with one sentence: file,
/// what was found, what to do; also if no Gaussian is left.
Result<GaussianCloud> read_gaussians(const std::filesystem::path& path, Progress& progress);

}  // namespace relief

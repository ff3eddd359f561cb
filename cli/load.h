// What the user's input files hold, in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief::cli {

/// Reads a scan or mesh with its materials and textures. What is left out of these is noted on
/// standard error.
Result<ReadResult> load_mesh(const std::filesystem::path& path, const TextureChoice& textures,
                             Progress& progress);

/// Reads one or more scans as one: positions in the files' own frames, one after the other. An
/// attribute that only some of the files have is left out, with a note; duplicates between files
/// are merged as within one.
Result<ReadResult> load_points(const std::vector<std::filesystem::path>& paths,
                               const TextureChoice& textures, Progress& progress);

/// A model from a .relief file, or from a scan or mesh that is converted with the default options.
Result<PatchModel> load_model(const std::filesystem::path& path, Progress& progress);

/// Points as the engine `ewa` takes them: colours linear and opaque, normals estimated or repaired
/// as for a conversion, radii from the distances to their neighbours. Faces only help to find
/// normals. Fails, with a clause, if there are too few points or the user interrupts.
Result<SplatCloud> splats_of_points(Points points, Progress& progress);

}  // namespace relief::cli

// Points of a textured mesh, with their texture coordinates.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Reads a mesh and the image that its texture coordinates refer to, `choice.image`: its points
/// with coordinates on the image, for an engine that looks colours up there. A point on a seam of
/// the texture has one of its coordinates. Fails if the mesh has none.
Result<SplatCloud> load_textured_points(const std::filesystem::path& mesh,
                                        const TextureChoice& choice, Progress& progress);

}  // namespace relief

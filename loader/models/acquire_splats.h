// Splats of a textured mesh, for an engine that splats points.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/texture/acquisition/acquisition.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Reads a mesh and the image that its texture coordinates refer to, `texture.image`, and makes
/// splats of them (preprocess/texture/acquisition/acquire_texture.h). Notes how the fit went.
Result<SplatCloud> acquire_splats(const std::filesystem::path& mesh, const TextureChoice& texture,
                                  const AcquireOptions& options, Progress& progress);

}  // namespace relief

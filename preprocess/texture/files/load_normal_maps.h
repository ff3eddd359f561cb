// Loads the normal maps of meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// Reads the normal maps of the materials of `points`; `image` is a resolved path, or the name of
/// `image_bytes`. Materials without texture coordinates get none. Fails with one sentence, which
/// names the image, if one is missing, too large or damaged. Adds a note for each normal map that
/// is left out.
Status load_normal_maps(const std::filesystem::path& mesh, Points& points,
                        std::vector<std::string>& notes);

}  // namespace relief

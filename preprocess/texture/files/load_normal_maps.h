// The normal maps of meshes, from what their files say to textures in memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// Reads the normal maps that the materials of `points` name: `picture` is a path by now, or says
/// whose `picture_bytes` they are. Materials without texture coordinates get none. Fails with one
/// sentence, which names the picture, if one is missing, too large or damaged; what a material
/// leaves out is a note.
Status load_normal_maps(const std::filesystem::path& mesh, Points& points,
                        std::vector<std::string>& notes);

}  // namespace relief

// From what a mesh file says about its colours to pictures in memory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// Where the colours and the normal maps of a mesh's triangles come from.
struct TextureChoice {
  bool left_out = false;          ///< what the file says about them is left out
  std::filesystem::path picture;  ///< one texture for all triangles instead, and no normal maps;
                                  ///< empty: the file's own
};

/// Reads the material files and the pictures (textures and normal maps) that `mesh`, which points
/// were read from, names, and leaves in `points` the materials that have colours; triangles of
/// others have kNoMaterial.
///
/// Names are relative to the folder of the file that they stand in. What would lead out of that
/// folder (an absolute path, a drive, ..) is looked for by its last part beside the file: files
/// from strangers must not make Relief read others.
///
/// Fails with one sentence if a picture that triangles use is missing, too large or damaged, or if
/// `choice` names one for a mesh that can have none. A material file that is missing is a note: the
/// shape is whole without it.
Status load_textures(const std::filesystem::path& mesh, const TextureChoice& choice, Points& points,
                     std::vector<std::string>& notes);

/// Whether some triangle has a colour of its own.
[[nodiscard]] bool has_triangle_colours(const Points& points);

/// Where a name in the file `owner` leads, as above.
[[nodiscard]] std::filesystem::path resolve_beside(const std::filesystem::path& owner,
                                                   const std::string& name);

}  // namespace relief

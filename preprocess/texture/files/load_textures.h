// Loads the materials and textures of meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// The source of colours and normal maps of a mesh's triangles.
struct TextureChoice {
  bool left_out = false;        ///< ignore the file's colours and normal maps
  std::filesystem::path image;  ///< one texture for all triangles instead, without normal maps;
                                ///< empty: the file's textures
  bool flips_v = false;         ///< the coordinates' v goes downward: it becomes 1 - v
  /// Points without triangles may have `image`, too: it is then their one material.
  bool of_points = false;
};

/// Reads the material files and images (textures and normal maps) that the file `mesh` names.
/// `points` are those read from `mesh`; they keep only materials with colours. Triangles of others
/// get kNoMaterial.
///
/// Names are relative to the folder of the file that contains them. If a name leads out of that
/// folder (an absolute path, a drive, ..), only its last part is used: untrusted files must not
/// make Relief read others.
///
/// A mesh with texture coordinates for which nobody names a picture gets a note.
///
/// Fails with one sentence if an image that triangles use is missing, too large or damaged, or if
/// `choice` names one for a mesh that can have none. A missing material file is only a note,
/// because the shape is complete without it.
Status load_textures(const std::filesystem::path& mesh, const TextureChoice& choice, Points& points,
                     std::vector<std::string>& notes);

/// Turns texture coordinates whose v goes downward, and tangents with them.
void flip_v(Points& points);

/// Returns whether some triangle has a material.
[[nodiscard]] bool has_triangle_colours(const Points& points);

/// Returns the path of a name in the file `owner`, as described for load_textures.
[[nodiscard]] std::filesystem::path resolve_beside(const std::filesystem::path& owner,
                                                   const std::string& name);

}  // namespace relief

// Reads the material files of OBJ meshes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// A material, and its options that Relief ignores.
struct MtlMaterial {
  MeshMaterial material;
  std::string ignored_options;  ///< ignored options of map_Kd that change the image; empty: none
  std::string
      ignored_of_normals;  ///< ignored options of the normal map that change it; empty: none
};

/// Reads a Wavefront MTL file: newmtl, Kd (as sRGB, like vertex colours), map_Kd and the normal map
/// (norm or map_Kn; -bm is a factor on its x and y), whose file names may have blanks. An image
/// replaces Kd, for which exporters write any grey, also black. map_Bump and bump are height images
/// and are not read; MeshNormalMap::left_out reports them if there is no normal map. Other
/// statements are ignored. Errors begin with `name`.
Result<std::vector<MtlMaterial>> read_mtl(const std::string& name, std::string_view text);

}  // namespace relief

// The material files of OBJ meshes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/points.h"

namespace relief {

/// A material with what Relief does not read of it.
struct MtlMaterial {
  MeshMaterial material;
  std::string ignored_options;     ///< of map_Kd; empty: none that change the picture
  std::string ignored_of_normals;  ///< the same of its normal map
};

/// Reads a Wavefront MTL file: newmtl, Kd (taken as sRGB, as vertex colours are), map_Kd and the
/// normal map (norm or map_Kn; -bm is a factor on its x and y), whose file names may have blanks. A
/// picture replaces Kd, which exporters leave at any grey, black among them. map_Bump and bump are
/// pictures of heights and are not read: MeshNormalMap::left_out says so where there is no normal
/// map. All other statements say nothing that is read of the look of a surface. `name` begins
/// errors.
Result<std::vector<MtlMaterial>> read_mtl(const std::string& name, std::string_view text);

}  // namespace relief

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
  bool clamps = false;          ///< -clamp on
  std::string ignored_options;  ///< of map_Kd; empty: none that change the picture
};

/// Reads a Wavefront MTL file: newmtl, Kd (taken as sRGB, as vertex colours are) and map_Kd, whose
/// file name may have blanks. A picture replaces Kd, which exporters leave at any grey, black among
/// them. All other statements say nothing about the colour of a surface. `name` begins errors.
Result<std::vector<MtlMaterial>> read_mtl(const std::string& name, std::string_view text);

}  // namespace relief

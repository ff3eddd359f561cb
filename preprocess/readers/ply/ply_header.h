// Reads the header of PLY files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/readers/number_type.h"
#include "preprocess/readers/source.h"

namespace relief {

struct PlyProperty {
  std::string name;  ///< in lower case
  NumberType type = NumberType::Float32;
  std::optional<NumberType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;  ///< in lower case
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;  ///< in file order
  /// Pictures that `comment TextureFile NAME` lines name, as MeshLab writes them.
  std::vector<std::string> textures;
  /// What a `comment SplatRenderMode: NAME` line states, in lower case: `mip` where 3D Gaussians
  /// were trained with the filter that keeps their integral. Brush, splat-transform and others
  /// write it.
  std::string splat_render_mode;
  std::size_t body = 0;  ///< offset of the first byte after the header
};

/// Reads the header. Counts are not yet checked against the bytes of the body.
Result<PlyHeader> read_ply_header(const Source& source);

}  // namespace relief

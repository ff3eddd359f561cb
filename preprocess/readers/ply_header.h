// What a PLY file says it holds.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/readers/source.h"

namespace relief {

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// Bytes of one value in the binary encodings.
[[nodiscard]] constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
  std::string name;  ///< in lower case
  PlyType type = PlyType::Float32;
  std::optional<PlyType> count_type;  ///< of a list
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
  std::size_t body = 0;              ///< offset of the first byte after the header
};

/// Reads the header. Counts are as stated, not yet checked against the bytes of the body.
Result<PlyHeader> read_ply_header(const Source& source);

}  // namespace relief

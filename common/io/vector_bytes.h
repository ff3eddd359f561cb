// Vectors in byte strings: their coordinates one after another.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/io/bytes.h"

namespace relief {

inline void append_vector(std::vector<std::byte>& out, const glm::dvec3& v) {
  for (glm::length_t c = 0; c < 3; ++c) append_number(out, v[c]);
}

[[nodiscard]] inline glm::dvec3 take_vector(ByteReader& in) {
  glm::dvec3 v;
  for (glm::length_t c = 0; c < 3; ++c) v[c] = in.take<double>();
  return v;
}

}  // namespace relief

// Tests vectors for NaN and infinity.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace relief {

/// Returns whether no component of a vector is NaN or infinite.
template <class Number, glm::qualifier Q>
[[nodiscard]] bool is_finite(const glm::vec<3, Number, Q>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace relief

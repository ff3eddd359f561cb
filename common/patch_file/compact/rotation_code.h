// Rotations in 12 bytes: a unit quaternion without its largest component.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>

namespace relief {

/// Three words; bits 30 and 31 of the first say which component is left out, the low 30 of each are
/// the others.
using RotationCode = std::array<std::uint32_t, 3>;

/// `axes` are orthonormal and right-handed; their directions come back within 4e-9 radians.
[[nodiscard]] RotationCode encode_rotation(const glm::dmat3& axes);

/// Any code gives a rotation.
[[nodiscard]] glm::dmat3 decode_rotation(const RotationCode& code);

}  // namespace relief

// Rotations in 12 bytes: a unit quaternion without its largest component.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>

namespace relief {

/// Three words. Bits 30 and 31 of the first are the index of the omitted component; the low 30 bits
/// of each are the others.
using RotationCode = std::array<std::uint32_t, 3>;

/// Encodes orthonormal, right-handed `axes`. Decoded directions are within 4e-9 radians.
[[nodiscard]] RotationCode encode_rotation(const glm::dmat3& axes);

/// Decodes a rotation; every code is valid.
[[nodiscard]] glm::dmat3 decode_rotation(const RotationCode& code);

}  // namespace relief

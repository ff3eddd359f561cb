// Checks the sizes and frames that headers state, and turns them into a placement.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "common/error.h"
#include "common/volume/scalar_volume.h"

namespace relief {

/// The frame of a file's coordinates.
struct FileFrame {
  /// Its axes as multiples of the world's, 1 or -1. {-1, -1, 1} turns left-posterior-superior into
  /// right-anterior-superior.
  glm::dvec3 signs{1.0};
  bool is_anatomical = false;  ///< the world's axes become right, anterior and superior
};

inline constexpr FileFrame kRasFrame{{1.0, 1.0, 1.0}, true};
inline constexpr FileFrame kLpsFrame{{-1.0, -1.0, 1.0}, true};

/// Anatomical volumes stand on their feet and face the viewer.
inline constexpr Stance kAnatomicalStance{{0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, false};

/// Fails on a size below 1, and on a volume that would take more than half of this machine's
/// memory, at `bytes_each` for each node.
Result<glm::uvec3> checked_size(const std::string& name, const std::array<std::int64_t, 3>& size,
                                std::uint64_t bytes_each = sizeof(float));

/// Fails if coordinates are not finite and if the steps are zero or lie in one plane. Steps may be
/// mirrored: values stay where the file says.
Result<RegularGrid> checked_grid(const std::string& name, const RegularGrid& grid,
                                 const FileFrame& frame);

/// Makes a volume without values yet.
Result<ScalarVolume> make_volume(const std::string& name, const std::array<std::int64_t, 3>& size,
                                 const RegularGrid& grid, const FileFrame& frame);

/// Returns a step matrix whose columns are the axes' directions times their spacings.
[[nodiscard]] inline glm::dmat3 scaled_axes(const glm::dmat3& directions,
                                            const glm::dvec3& spacing) {
  return {directions[0] * spacing.x, directions[1] * spacing.y, directions[2] * spacing.z};
}

}  // namespace relief

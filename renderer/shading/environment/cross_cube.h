// Cubes from images of their faces as someone within them sees them, straight ahead toward -Z.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/shading/environment/cube_map.h"

namespace relief {

/// Whether an image of that size is a cross of six square faces: four wide and three high, or
/// three wide and four high.
[[nodiscard]] bool is_cross(std::size_t width, std::size_t height);

/// The cube of a cross of that size, row-major (load_environment says which face is where).
[[nodiscard]] CubeMap cut_cross(const std::vector<glm::vec3>& texels, std::size_t width,
                                std::size_t height);

/// The cube of six images, row-major, in the order of environment_files: right, left, above,
/// below, ahead, behind. Above and below join the one ahead with their lower and upper edges. All
/// have `size` times `size` texels.
[[nodiscard]] CubeMap join_faces(const std::array<std::vector<glm::vec3>, 6>& faces,
                                 std::size_t size);

}  // namespace relief

// The surroundings as six images around the eye: made and looked up on the CPU, uploaded for the
// GPU, so that all engines see the same.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"

namespace relief {

/// A cube map of linear light in world directions, faces as OpenGL numbers and turns them: +X, -X,
/// +Y, -Y, +Z, -Z (OpenGL 4.5, table 8.19).
struct CubeMap {
  std::uint32_t size = 0;                         ///< texels along a face's side
  std::array<std::vector<glm::vec3>, 6> faces{};  ///< row-major, t downward in the world
};

/// The direction (any length) at (s, t) in [-1, 1] of a face. Values outside lie beyond its edges.
[[nodiscard]] glm::dvec3 cube_direction(std::size_t face, glm::dvec2 st);

/// The light from a direction (any length but 0): bilinear, seamless over the edges of the cube.
[[nodiscard]] glm::vec3 look_up(const CubeMap& cube, glm::dvec3 direction);

/// The surroundings from an EXR or HDR image, equirectangular (+Y up, its middle toward -Z, its
/// right half toward +X) or a cross of six faces as seen from within, four wide and three high or
/// three wide and four high (its middle toward -Z; in the second row +X is right of it and -X left,
/// +Y above and -Y below; +Z at the right end, or upside down at the lower end). Six files, a face
/// each, lie as in the cross that is four wide (environment_files says how they are named). If
/// `path` is empty, the built-in sky with a grid. Non-finite values become 0, negative ones too,
/// those above what half floats hold are clamped. Fails if a file can't be read or has no colour,
/// or if six faces are not square and of one size.
Result<CubeMap> load_environment(const std::filesystem::path& path);

}  // namespace relief

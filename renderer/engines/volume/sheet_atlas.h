// Where a regular grid's sheets lie in one texture, and which of its squares hold something.
#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

namespace relief::volume {

/// Sheets row by row.
struct SheetAtlas {
  glm::ivec2 pitch{0};  ///< texels from a sheet to the next
  int columns = 0;      ///< sheets in a row
  glm::ivec2 texels{0};
};

/// Texels around each sheet that hold nothing but what kernels at its border are widened to: a
/// square of kVolumeSheetTile.
inline constexpr int kSheetMargin = 16;

/// Nodes that kernels are widened over at most, either way: the next sheet is out of reach.
inline constexpr int kLargestReach = 12;

/// For sheets of size.x * size.y nodes, size.z of them. None if a texture of `most` texels a side
/// does not hold them.
[[nodiscard]] std::optional<SheetAtlas> sheet_atlas(glm::ivec3 size, int most);

/// Squares of kVolumeSheetTile texels a side, aligned to the sheets' first nodes (first node along u
/// and v, sheet, 0).
using SheetTiles = std::vector<glm::ivec4>;

/// The squares that hold a texel with w above 0, or have one within `reach` nodes along u and v.
/// `texels`: x fastest; `axes`: which of x, y, z are u, v and w.
[[nodiscard]] SheetTiles sheet_tiles(std::span<const glm::u16vec4> texels, glm::ivec3 size,
                                     glm::ivec3 axes, glm::ivec2 reach);

}  // namespace relief::volume

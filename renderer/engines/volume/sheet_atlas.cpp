#include "renderer/engines/volume/sheet_atlas.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

constexpr int kSquare = shared::kVolumeSheetTile;

/// The square that holds a node; below 0 before the sheet.
int square_of(int node) {
  return node >= 0 ? node / kSquare : -((kSquare - 1 - node) / kSquare);
}

}  // namespace

std::optional<SheetAtlas> sheet_atlas(glm::ivec3 size, int most) {
  // Squares at the far border may reach as far as the margin goes, and no farther.
  const glm::ivec2 pitch = (glm::ivec2(size) + kSquare - 1) / kSquare * kSquare + 2 * kSheetMargin;
  if (std::max(pitch.x, pitch.y) > most) return std::nullopt;
  // About as high as wide.
  const double wide = std::sqrt(static_cast<double>(pitch.y) * size.z / pitch.x);
  const int columns = std::clamp(static_cast<int>(std::ceil(wide)), 1, most / pitch.x);
  const int rows = (size.z + columns - 1) / columns;
  if (rows > most / pitch.y) return std::nullopt;
  return SheetAtlas{pitch, columns, pitch * glm::ivec2(columns, rows)};
}

SheetTiles sheet_tiles(std::span<const glm::u16vec4> texels, glm::ivec3 size, glm::ivec3 axes,
                       glm::ivec2 reach) {
  const std::array<std::size_t, 3> strides{
      1, static_cast<std::size_t>(size.x),
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  const auto stride = [&](int axis) { return strides[static_cast<std::size_t>(axis)]; };
  const glm::ivec2 sheet(size[axes.x], size[axes.y]);
  const glm::ivec2 margin(square_of(-reach.x), square_of(-reach.y));
  const glm::ivec2 squares(square_of(sheet.x - 1 + reach.x) - margin.x + 1,
                           square_of(sheet.y - 1 + reach.y) - margin.y + 1);
  std::vector<SheetTiles> of_sheets(static_cast<std::size_t>(size[axes.z]));
  tbb::parallel_for(0, size[axes.z], [&](int w) {
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(squares.x) *
                                    static_cast<std::size_t>(squares.y));
    for (int v = 0; v < sheet.y; ++v) {
      for (int u = 0; u < sheet.x; ++u) {
        const std::size_t at = static_cast<std::size_t>(u) * stride(axes.x) +
                               static_cast<std::size_t>(v) * stride(axes.y) +
                               static_cast<std::size_t>(w) * stride(axes.z);
        if (texels[at].w == 0) continue;
        for (int y = square_of(v - reach.y); y <= square_of(v + reach.y); ++y) {
          for (int x = square_of(u - reach.x); x <= square_of(u + reach.x); ++x)
            marks[static_cast<std::size_t>((y - margin.y) * squares.x + x - margin.x)] = 1;
        }
      }
    }
    for (std::size_t s = 0; s < marks.size(); ++s) {
      if (marks[s] == 0) continue;
      const glm::ivec2 at(static_cast<int>(s) % squares.x, static_cast<int>(s) / squares.x);
      of_sheets[static_cast<std::size_t>(w)].emplace_back((at + margin) * kSquare, w, 0);
    }
  });
  SheetTiles tiles;
  for (const SheetTiles& own : of_sheets) tiles.insert(tiles.end(), own.begin(), own.end());
  return tiles;
}

}  // namespace relief::volume

// The tiles of a patch file of version 3.
#pragma once

#include <cstdint>
#include <limits>

#include "common/bounds.h"

namespace relief {

/// The parent index of a tile without a parent.
inline constexpr std::uint32_t kNoTile = std::numeric_limits<std::uint32_t>::max();

/// The patches of a region. Tiles of level 0 have the model's own patches. A tile of a higher level
/// shows the surface of its children, which are tiles of the level below, with fewer and larger
/// samples.
struct TreeTile {
  std::uint64_t offset = 0;  ///< in the file
  std::uint64_t bytes = 0;
  std::uint64_t samples = 0;
  std::uint32_t patches = 0;
  std::uint32_t parent = kNoTile;  ///< an earlier tile
  std::uint32_t level = 0;
  double spacing = 0.0;  ///< of its samples, world units
  Bounds box;            ///< about its samples, world; empty if it has none
};

}  // namespace relief

// Tiles that come as near to what a view is to show as a budget allows.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "common/patch_file/tree_tile.h"

namespace relief {

/// Returns tiles on the way to `goal` (choose_tiles(), renderer/view/patches_in_view.h): beginning
/// with those without a parent, each that is too coarse gives way to its children on the way, the
/// coarsest first, if those fit. Equal to `goal` if all do. Ascending.
/// `coarseness`: of a tile, above 0. `add`: whether tiles fit beside those that were added before;
/// if so, adds them. What it says of the first ones does not count.
[[nodiscard]] std::vector<std::uint32_t> choose_within(
    std::span<const TreeTile> tiles, std::span<const std::uint32_t> goal,
    const std::function<double(std::uint32_t)>& coarseness,
    const std::function<bool(std::span<const std::uint32_t>)>& add);

}  // namespace relief

// Drops the lines that do not bound what is left of a disc.
#pragma once

#include <vector>

#include "renderer/clip/lines/plane_line.h"

namespace relief {

/// Keeps of groups of lines those that bound the result inside the disc. The areas of a group are
/// intersected, the groups united. What a line changes by less than 0.0001 radii counts as nothing.
void keep_bounding_lines(std::vector<LineGroup>& groups, const SplatFrame& frame);

}  // namespace relief

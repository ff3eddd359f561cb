// Keeps samples of patches that meet apart.
#pragma once

#include <span>

#include "common/patch.h"

namespace relief {

/// Turns samples at borders into holes where samples of two patches are nearer to each other than
/// 0.45 spacings, between which triangles would be slivers: of two, the one that its patch sees
/// more askew.
void thin_borders(std::span<Patch> patches);

}  // namespace relief

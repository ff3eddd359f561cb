// A scan that needs no download: points on a bumpy, coloured trefoil knot.
#pragma once

#include <cstddef>
#include <string>

namespace relief {

/// About `points` points of the knot, closed, without normals, noise or faces, as a binary
/// little-endian PLY file (float x y z, uchar red green blue). The knot fills about [-3.5, 3.5]^2 x
/// [-1.6, 1.6]. The same number gives the same bytes.
[[nodiscard]] std::string knot_scan_ply(std::size_t points);

}  // namespace relief

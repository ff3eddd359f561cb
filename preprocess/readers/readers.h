// One reader per format: bytes in, points as the file has them out.
#pragma once

#include "preprocess/readers/source.h"

namespace relief {

/// Each reader returns every point of the file, NaN and duplicates included, with the attributes
/// that all points have. Triangles may name points that do not exist; clean_points drops them. A
/// reader never crashes, hangs or takes memory out of proportion to the file, whatever the bytes;
/// it fails with one sentence that begins with the file's name and says line or byte.

/// PLY 1.0, ASCII or binary in both byte orders. Positions x y z of any number type; normals nx ny
/// nz; colours red green blue (or r g b, diffuse_red ...); texture coordinates s t, u v or
/// texture_u texture_v; faces from `vertex_indices` or `vertex_index` of element `face` and from
/// `tristrips`. Everything else is skipped; so is `range_grid`, whose neighbours may be on
/// different surfaces.
Result<Points> read_ply(const Source& source);

}  // namespace relief

// Points and triangles as files that other programs read.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// What is written: positions, and normals, colours and triangles where `points` has them. Vectors
/// are as Points says; without triangles each file is one of points. Nothing else of it is looked
/// at.
struct ExportRequest {
  const Points& points;
  /// How far a position may be off, world units. Where single precision is farther off, PLY has
  /// doubles and glTF a node that is moved.
  double tolerance = 0.0;
  bool is_closed = false;  ///< glTF shows back sides unless it is
};

/// Each writes a file that appears whole or not at all. Fails with one sentence (disk full, more
/// than the format can hold), or if the user interrupts.

/// PLY 1.0, binary_little_endian: float or double x y z, float nx ny nz, uchar red green blue, and
/// a list of three for each triangle.
Status export_ply(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// Wavefront OBJ: `v x y z`, with r g b from 0 to 1 behind, `vn`, and `f a//a b//b c//c`. A
/// position has the digits that make the very same double.
Status export_obj(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// glTF 2.0, binary: one node, one mesh, POSITION and NORMAL as floats, COLOR_0 linear in 16 bits.
/// The node is moved, by what a float holds, where floats would not be exact enough without. Axes
/// are the scan's, though glTF calls +Y up.
Status export_glb(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// Whether a float's rounding of some position is more than `tolerance`.
[[nodiscard]] bool needs_doubles(const Points& points, double tolerance);

}  // namespace relief

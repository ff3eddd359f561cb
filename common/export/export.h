// Exports points and triangles to files of other programs.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"

namespace relief {

/// The data to write: positions, and normals, colours, scalars and triangles if `points` has them.
/// Without triangles the file holds points. Other members are ignored.
struct ExportRequest {
  const Points& points;
  /// Largest error of a position, world units. If single precision exceeds it, PLY stores doubles
  /// and glTF translates its node.
  double tolerance = 0.0;
  bool is_closed = false;  ///< glTF materials are double-sided unless set
};

/// Each function writes a file atomically. It fails with one sentence (disk full, more than the
/// format can hold), or if the user interrupts.

/// PLY 1.0, binary_little_endian: float or double x y z, float nx ny nz, uchar red green blue, each
/// scalar under its name (ushort for labels, NaN for none), and a list of three for each triangle.
/// The other formats have no place for scalars.
Status export_ply(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// Wavefront OBJ: `v x y z`, followed by r g b from 0 to 1, `vn`, and `f a//a b//b c//c`. Positions
/// have enough digits to restore the double exactly.
Status export_obj(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// glTF 2.0, binary: one node, one mesh, POSITION and NORMAL as floats, COLOR_0 linear in 16 bits.
/// The node is translated, by values that floats hold exactly, if floats would exceed the tolerance
/// without. Axes are the scan's, although glTF calls +Y up.
Status export_glb(const std::filesystem::path& path, const ExportRequest& request,
                  Progress& progress);

/// Returns whether rounding some position to floats changes it by more than `tolerance`.
[[nodiscard]] bool needs_doubles(const Points& points, double tolerance);

}  // namespace relief

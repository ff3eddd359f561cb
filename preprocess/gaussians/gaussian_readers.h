// The readers of Gaussians, one a format.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "common/volume/gaussian_cloud.h"
#include "preprocess/readers/ply/ply_header.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Reads a file in memory as read_gaussians does. `path` gives the format and begins errors.
Result<GaussianCloud> read_gaussian_bytes(const std::filesystem::path& path,
                                          std::span<const std::byte> bytes, Progress& progress);

/// Each reader returns Gaussians as GaussianCloud promises. On any bytes, a reader never crashes or
/// hangs, or takes memory out of proportion to the file. It fails with one sentence that begins
/// with the file's name. Formats differ in the frame: files in PLY have Y down and Z away from the
/// viewer, .spz files that of GaussianCloud.

/// Whether a PLY header has the properties of the files that [Kerbl 2023]'s training writes.
[[nodiscard]] bool has_plain_gaussians(const PlyHeader& header);

/// Reads these files, in any encoding: x y z; f_dc_0 to f_dc_2 and f_rest_0 on, harmonics of degree
/// 0 to 4, all of red, then green, then blue; opacity as a logit, where infinity is 0 or 1; scale_0
/// to scale_2 as natural logarithms; rot_0 to rot_3 as w x y z, of any length.
Result<GaussianCloud> read_gaussian_ply(const Source& source, const PlyHeader& header);

/// Whether a PLY header has the properties of PlayCanvas's compressed files.
[[nodiscard]] bool has_compressed_gaussians(const PlyHeader& header);

/// Reads these files: Gaussians of 16 bytes, relative to the ranges of chunks of 256. Written by
/// SuperSplat (.compressed.ply); as in playcanvas/splat-transform 2.7.1, `decompress-ply.ts` and
/// `compressed-chunk.ts`, and playcanvas/engine, `gsplat-compressed-data.js` (MIT).
Result<GaussianCloud> read_compressed_ply(const Source& source, const PlyHeader& header);

/// Reads .spz files of versions 1 to 4, as in nianticlabs/spz, `load-spz.cc`, `README.md` and
/// `extensions/README.md` (MIT). Of their extensions, the coordinate system is used; those that
/// turn a quarter about X are refused, and so are Spark's trees of levels of detail.
Result<GaussianCloud> read_spz(const Source& source);

}  // namespace relief

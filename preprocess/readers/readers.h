// The readers, one a format: they turn bytes into the points of the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/readers/read_result.h"
#include "preprocess/readers/source.h"

namespace relief {

/// Reads a file in memory as read_points does: decompresses it, finds its format, reads and cleans.
/// `path` gives the extension and begins errors.
Result<ReadResult> read_bytes(const std::filesystem::path& path, std::vector<std::byte> bytes,
                              Progress& progress, const ReadOptions& options = {});

/// Each reader returns every point of the file, NaN and duplicates included, with the attributes
/// that all points have, and the scalars that Source::scalars asks for. Triangles may have invalid
/// indices; clean_points drops them. On any bytes, a reader never crashes, hangs, throws or takes
/// memory out of proportion to the file. It fails with one sentence that begins with the file's
/// name and gives the line or byte.

/// Reads PLY 1.0, ASCII or binary in both byte orders. Positions x y z of any number type; normals
/// nx ny nz; colours red green blue (or r g b, diffuse_red ...); texture coordinates s t, u v or
/// texture_u texture_v; faces from `vertex_indices` or `vertex_index` of element `face` and from
/// `tristrips`. Everything else is skipped; so is `range_grid`, whose neighbours may be on
/// different surfaces.
Result<Points> read_ply(const Source& source);

/// Reads PCD 0.7 and earlier: ascii, binary, binary_compressed. Fields x y z of any number type,
/// normal_x normal_y normal_z, rgb or rgba packed in a float or an integer, r g b. Keeps a
/// viewpoint other than the default, and the default of points in rows and columns (HEIGHT above
/// 1), which are a camera's.
Result<Points> read_pcd(const Source& source);

/// Reads LAS 1.1 to 1.4, point record formats 0 to 10, and LAZ, without its scalars, if the build
/// has LASzip; skips waveforms. Leaves out points that are marked as withheld, classified as noise
/// (if no classes are selected) or not selected; fails if no point is left. Keeps the upper byte of
/// 16-bit colours. If no colour of the file is above 255, they are 8-bit values; if all are 0, the
/// file has no colours. Says whether the scan looks airborne (looks_airborne).
Result<Points> read_las(const Source& source);

/// Reads Wavefront OBJ: v (also with colours), vn, vt, f with polygons and negative indices, lines
/// continued with a backslash; names of materials and of their files. A vertex gets the mean of its
/// corners' normals and its first corner's texture coordinates; triangles keep their own at seams.
Result<Points> read_obj(const Source& source);

/// Reads glTF 2.0, as JSON or binary (.glb), with embedded or external buffers and images: all
/// meshes of the default scene, transformed by their nodes; POSITION, NORMAL, TANGENT and the
/// texture coordinates of base colours; triangles, strips and fans; base colour factor and texture
/// and the normal map of each material. If all materials are white and without images, vertex
/// colours (COLOR_0) are used instead. Fails on sparse accessors and on required extensions, with
/// their names.
Result<Points> read_gltf(const Source& source);

/// Reads OFF as text, with the prefixes ST, C and N, with or without the keyword.
Result<Points> read_off(const Source& source);

/// Reads Draco (.drc) of bitstream 2.2 and later, point clouds and meshes: positions, normals,
/// colours, texture coordinates, triangles.
Result<Points> read_drc(const Source& source);

/// Reads STL, ASCII or binary. Each facet has its own three points; clean_points merges them. Facet
/// normals are not read, because the triangles define them.
Result<Points> read_stl(const Source& source);

/// Reads text with a point a line and numbers separated by blanks, commas or semicolons.
/// find_column_roles determines the meaning of the columns. Skips lines before the numbers, and
/// comments (#, //, %).
Result<Points> read_xyz(const Source& source);

/// Reads PTX: scans of columns times rows, each with a matrix that transforms its points into the
/// world; x y z intensity, or with r g b. Points at 0 0 0 are beams without an echo and become NaN.
/// The viewpoint is the position of a single scan; several scans are several scanners. Recognised
/// only by its extension.
Result<Points> read_ptx(const Source& source);

/// Return whether the first bytes, or the length, are those of the format.
[[nodiscard]] bool is_ply(std::string_view text);
[[nodiscard]] bool is_pcd(std::string_view text);
[[nodiscard]] bool is_las(std::string_view text);
[[nodiscard]] bool is_glb(std::string_view text);
[[nodiscard]] bool is_drc(std::string_view text);
[[nodiscard]] bool is_off(std::string_view text);
/// ASCII files are recognised by their first words, binary ones if their length matches the stated
/// number of facets. Other text never matches: its 81st to 84th characters, as a number, would mean
/// 25 GB or more.
[[nodiscard]] bool is_stl(std::string_view text);

}  // namespace relief

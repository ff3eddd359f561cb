// One reader per format: bytes in, points as the file has them out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "preprocess/readers/read_points.h"
#include "preprocess/readers/source.h"

namespace relief {

/// read_points for bytes that are already in memory: decompresses them, finds the format, reads and
/// cleans. `path` tells the format where the bytes do not, and begins errors.
Result<ReadResult> read_bytes(const std::filesystem::path& path, std::vector<std::byte> bytes,
                              Progress& progress);

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

/// PCD 0.7 and earlier: ascii, binary, binary_compressed. Fields x y z of any number type, normal_x
/// normal_y normal_z, rgb or rgba packed in a float or an integer, r g b. A viewpoint that is not
/// the default is kept.
Result<Points> read_pcd(const Source& source);

/// LAS 1.1 to 1.4, point record formats 0 to 10; waveforms and extra bytes are passed over. Left
/// out are points that the file marks as withheld, or classifies as noise. Of 16-bit colours the
/// upper byte is kept; where none of the file is above 255, they are 8-bit values and taken as they
/// are; where all are 0, there are none.
Result<Points> read_las(const Source& source);

/// Wavefront OBJ: v (also with colours), vn, vt, f with polygons and negative indices, lines
/// continued with a backslash; names of materials and of their files. A vertex gets the mean of its
/// corners' normals and its first corner's texture coordinates; triangles keep their own at seams.
Result<Points> read_obj(const Source& source);

/// glTF 2.0, as JSON or binary (.glb), with embedded or external buffers and pictures: all meshes
/// of the default scene in the places of their nodes; POSITION, NORMAL, TANGENT and the texture
/// coordinates of base colours; triangles, strips and fans; base colour factor and texture and the
/// normal map of each material. Where all materials are white and without pictures, the colours of
/// vertices (COLOR_0) count instead.
/// Sparse accessors, and extensions that a file requires, are refused by name.
Result<Points> read_gltf(const Source& source);

/// OFF as text, with the prefixes ST, C and N, with or without the keyword.
Result<Points> read_off(const Source& source);

/// Draco (.drc) of bitstream 2.2 and later, point clouds and meshes: positions, normals, colours,
/// texture coordinates, triangles.
Result<Points> read_drc(const Source& source);

/// STL, ASCII or binary. Each facet brings its own three points; clean_points merges them. Facet
/// normals are not read: the triangles have them.
Result<Points> read_stl(const Source& source);

/// A point per line, numbers separated by blanks, commas or semicolons; what the columns mean is
/// found by find_column_roles. Lines above the numbers and comments (#, //, %) are passed over.
Result<Points> read_xyz(const Source& source);

/// PTX: scans of columns times rows, each with a matrix that puts its points into the world; x y z
/// intensity, or with r g b. Points at 0 0 0 are beams that did not come back and become NaN. A
/// single scan's place is the viewpoint. Known by its name alone.
Result<Points> read_ptx(const Source& source);

/// Whether the first bytes, or the length, are as the format demands.
[[nodiscard]] bool is_ply(std::string_view text);
[[nodiscard]] bool is_pcd(std::string_view text);
[[nodiscard]] bool is_las(std::string_view text);
[[nodiscard]] bool is_glb(std::string_view text);
[[nodiscard]] bool is_drc(std::string_view text);
[[nodiscard]] bool is_off(std::string_view text);
/// ASCII by its first words; binary if the file's length is exactly that of the facets it states.
/// Other text never passes: its 81st to 84th characters, taken as a number, ask for 25 GB or more.
[[nodiscard]] bool is_stl(std::string_view text);

}  // namespace relief

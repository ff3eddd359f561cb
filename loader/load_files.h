// Scans, meshes and patch files in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/patch_file/patch_file.h"
#include "common/progress.h"
#include "preprocess/readers/read_points.h"
#include "preprocess/texture/files/load_textures.h"
#include "renderer/geometry/splat_cloud.h"

namespace relief {

/// Reads a scan or mesh with its materials and textures, and the scalars that are asked for. Adds a
/// note for each that is left out. Z is up for a mesh that stands so (common/mesh/footing.h),
/// unless its file says what is up.
Result<ReadResult> load_mesh(const std::filesystem::path& path, const TextureChoice& textures,
                             Progress& progress, const ReadOptions& options = {});

/// Reads one or more scans as one scan, in the frame of their coordinates. A .conf file names scans
/// and the pose of each (preprocess/readers/scan_poses.h). Leaves out an attribute that only some
/// of the files have, and notes it. Merges duplicates between files as within one.
/// The crop is in that frame.
Result<ReadResult> load_points(const std::vector<std::filesystem::path>& paths,
                               const TextureChoice& textures, Progress& progress,
                               const ReadOptions& options = {});

/// What was read of a patch file.
struct ReadPatches {
  PatchModel model;
  SectionBytes bytes;
};

/// Reads a .relief file, of its patches only the maps that `sections` names. Fails if the options
/// select points.
Result<ReadPatches> load_patches(const std::filesystem::path& path, Progress& progress,
                                 const ReadOptions& options, const PatchSections& sections);

/// Reads a .relief file, or a scan or mesh and converts it with the default options. Fails if the
/// options select points of a .relief file. A raster becomes patches as it is; `textures` is laid
/// over it, and not over others.
Result<PatchModel> load_model(const std::filesystem::path& path, Progress& progress,
                              const ReadOptions& options = {}, const TextureChoice& textures = {});

/// Makes splats of points: colours are linear and opaque, normals are estimated or repaired as for
/// a conversion, radii follow from the distances to the neighbours. Faces only help to find
/// normals. Fails, with a clause, if there are too few points or the user interrupts.
Result<SplatCloud> splats_of_points(Points points, Progress& progress);

}  // namespace relief

// What the user's input files hold, in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/read_points.h"
#include "renderer/triangle_mesh.h"

namespace relief::cli {

/// Reads one or more scans as one: positions in the files' own frames, one after the other. An
/// attribute that only some of the files have is left out, with a note; duplicates between files
/// are merged as within one.
Result<ReadResult> load_points(const std::vector<std::filesystem::path>& paths, Progress& progress);

/// A model from a .relief file, or from a scan or mesh that is converted with the default options.
Result<PatchModel> load_model(const std::filesystem::path& path, Progress& progress);

/// What rays are traced through, and the sphere that the camera's orbit is about: the same for a
/// mesh as for the patches made from it.
struct TraceableModel {
  std::variant<PatchModel, TriangleMesh> model;
  Bounds bounds;
  double bounding_radius = 0.0;
};

/// The triangles of a mesh file; the patches of a .relief file, or of a scan without triangles,
/// converted with the default options.
Result<TraceableModel> load_traceable(const std::filesystem::path& path, Progress& progress);

}  // namespace relief::cli

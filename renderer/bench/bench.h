// Times images against each other in one run, and against what bounds them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "renderer/geometry/triangle_mesh.h"
#include "renderer/settings.h"

namespace relief {

/// One way to draw: what, and how. An engine on OpenGL.
struct BenchMethod {
  const PatchModel* patches = nullptr;
  RenderSettings settings;
};

/// What is timed; models outlive the bench.
struct BenchJob {
  std::vector<BenchMethod> rows;       ///< all of one camera, size, material and platform
  const TriangleMesh* mesh = nullptr;  ///< the input, if it has faces
  std::size_t reference = 0;           ///< the row whose covered pixels the shading bound has
  int frames = 20;                     ///< timed rounds
  int warm_up = 2;                     ///< rounds before them
};

/// Medians over the timed rounds.
struct BenchTime {
  double frame_ms = 0.0;         ///< wall clock, from the first command until all have finished
  std::optional<double> gpu_ms;  ///< OpenGL's timer, if it has one
};

struct BenchRow {
  BenchTime time;
  std::uint64_t covered_pixels = 0;
  std::uint64_t fragments = 0;    ///< shaded by the model's passes
  std::uint64_t gpu_bytes = 0;    ///< of all buffers and textures that a frame binds
  std::uint64_t model_bytes = 0;  ///< of those that no framebuffer draws into
};

struct BenchReport {
  std::string renderer;        ///< OpenGL's own name
  std::vector<BenchRow> rows;  ///< parallel to BenchJob::rows
  /// A pass that shades as many pixels as the reference row covers, with the same material and
  /// lookups: what no image of it can be faster than. Nothing if it covers none.
  std::optional<BenchRow> shading_bound;
  /// The input mesh as one indexed triangle list with vertex normals (and colours), the same
  /// material, nothing culled.
  std::optional<BenchRow> mesh;
};

/// Draws every row once for its counts, then `warm_up + frames` rounds: frame k of
/// every row, of the bound and of the mesh, before frame k + 1 of any, so that a machine that
/// drifts drifts for all. Everything is in one OpenGL context. Fails as render() does.
Result<BenchReport> bench(const BenchJob& job, Progress& progress);

}  // namespace relief

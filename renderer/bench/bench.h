// Times images against each other in one run, and against what bounds them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/bench/bench_row.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief {

/// What is timed; models outlive the bench.
struct BenchJob {
  std::vector<BenchMethod> rows;       ///< all of one camera, size, material and platform
  const TriangleMesh* mesh = nullptr;  ///< the input, if it has faces
  /// The row whose covered pixels the shading bound has: on OpenGL, of patches. None: there is no
  /// bound.
  std::optional<std::size_t> reference;
  int frames = 20;  ///< timed rounds
  int warm_up = 2;  ///< rounds before them; one on the CPU
};

struct BenchReport {
  std::string renderer;        ///< OpenGL's own name, or "CPU" if no row is on OpenGL
  std::vector<BenchRow> rows;  ///< parallel to BenchJob::rows
  /// A pass that shades as many pixels as the reference row covers, with the same material and
  /// lookups: what no image of it can be faster than. Nothing if it covers none.
  std::optional<BenchRow> shading_bound;
  /// The input mesh as one indexed triangle list with vertex normals (and colours), the same
  /// material, nothing culled. None if no row is on OpenGL.
  std::optional<BenchRow> mesh;
};

/// Draws every row once for its counts, then `warm_up + frames` rounds: frame k of
/// every row, of the bound and of the mesh, before frame k + 1 of any, so that a machine that
/// drifts drifts for all. Everything is in one OpenGL context. Rows on the CPU follow, in turns of
/// their own. Fails as render() does.
Result<BenchReport> bench(const BenchJob& job, Progress& progress);

}  // namespace relief

// The seams between patches on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include "common/background_tasks.h"
#include "common/error.h"
#include "common/patch.h"
#include "common/seams/seams.h"
#include "renderer/geometry/cells/facing.h"
#include "renderer/geometry/cells/levels.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/store_limits.h"
#include "shaders/include/shared.h"

namespace relief {

/// A square of a patch's share of the seams, wherever it stands: corners of triangles.
struct SeamBlock {
  std::uint32_t first = 0;  ///< in SeamStore::corners
  std::uint32_t count = 0;
  /// Those of the patch's outermost cells, which follow: over a coarser level they close what is
  /// open between that and the seams.
  std::uint32_t ring = 0;
  NormalBounds normals;    ///< of all of them
  glm::vec3 centre{0.0F};  ///< of a sphere about them, grid frame (cells)
  float radius = 0.0F;     ///< of that sphere, cells
};

/// Those of a patch.
using SeamBlocks = std::vector<SeamBlock>;

/// What the CPU keeps of a placed patch's share.
struct StoredSeam {
  std::uint32_t patch = 0;   ///< in PatchStore::patches: its finest level
  std::uint32_t number = 0;  ///< in CellStore::positions, whose attribute names that
  glm::dvec3 centre{0.0};    ///< of a sphere about it, world frame
  double radius = 0.0;
  PatchExtent extent;  ///< of the patch
  SeamBlocks blocks;
};

struct SeamStore {
  std::vector<StoredSeam> seams;
  Table vertices;          ///< shared::SeamVertex
  Buffer corners;          ///< three a triangle: numbers of vertices
  VertexArray attributes;  ///< corners, and per instance the patch
};

/// Collects the seams of runs of patches and uploads them.
class SeamUpload {
 public:
  /// Begins to make the seams of all runs in the background, while patches are uploaded: a thread
  /// takes about as long for the one as for the other. `model` must outlive it. `needed`: get()
  /// will be called; `with_rings`: coarser levels may be drawn.
  SeamUpload(const StoreLimits& limits, const PatchModel& model, bool needed, bool with_rings);

  /// The seams of a run. Not after get() of it.
  const Seams& made(PatchRun run);

  /// The shares of the patches of a run, made once. Fails if OpenGL lets no shader see as many.
  Result<std::span<const SeamBlocks>> get(PatchRun run);

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  /// `positions`: CellStore::positions.
  SeamStore take(const Gl& gl, std::vector<StoredSeam> seams, const Buffer& positions);

  /// What take() uploads.
  [[nodiscard]] std::vector<shared::SeamVertex>& vertices() { return vertices_; }
  [[nodiscard]] std::vector<std::uint32_t>& corners() { return corners_; }

 private:
  std::size_t most_texels_;
  const PatchModel& model_;
  bool with_rings_;
  std::map<std::uint32_t, Seams> made_;                    ///< by first patch, until asked for
  std::map<std::uint32_t, std::vector<SeamBlocks>> runs_;  ///< the same
  std::vector<shared::SeamVertex> vertices_;
  std::vector<std::uint32_t> corners_;
  BackgroundTasks making_;
};

}  // namespace relief

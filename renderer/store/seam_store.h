// The seams between patches on the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "shaders/include/shared.h"

namespace relief {

/// A patch's share of the seams, wherever it stands: corners of triangles.
struct SeamCorners {
  std::uint32_t first = 0;  ///< in SeamStore::corners
  std::uint32_t count = 0;
};

/// What the CPU keeps of a placed patch's share.
struct StoredSeam {
  std::uint32_t patch = 0;   ///< in PatchStore::patches: its finest level
  std::uint32_t number = 0;  ///< in CellStore::positions, whose attribute names that
  glm::dvec3 centre{0.0};    ///< of a sphere about it, world frame
  double radius = 0.0;
  SeamCorners corners;
};

struct SeamStore {
  std::vector<StoredSeam> seams;
  Table vertices;  ///< shared::SeamVertex
  Table corners;   ///< three a triangle: numbers of vertices
};

/// Collects the seams of runs of patches and uploads them.
class SeamUpload {
 public:
  explicit SeamUpload(const Gl& gl) : gl_(gl) {}

  /// The shares of the patches of a run, made once. Fails if OpenGL lets no shader see as many.
  Result<std::span<const SeamCorners>> get(const PatchModel& model, PatchRun run);

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  SeamStore take(std::vector<StoredSeam> seams);

 private:
  const Gl& gl_;
  std::map<std::uint32_t, std::vector<SeamCorners>> runs_;  ///< by first patch
  std::vector<shared::SeamVertex> vertices_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace relief

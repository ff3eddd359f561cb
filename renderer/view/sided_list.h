// Which patches a frame draws with both sides, and which without what faces away from the eye.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/view.h"

namespace relief {

/// What a frame draws, in its order: of these things both sides, and of those the front alone.
struct SidedList {
  std::vector<std::uint32_t> both;
  std::vector<std::uint32_t> front;
};

/// Whether a view shows both sides of some instance.
[[nodiscard]] bool shows_backs(const PatchStore& store, const View& view);

/// Which patches of the store a view shows with both sides.
[[nodiscard]] SidedList by_cull_mode(const PatchStore& store, const View& view,
                                     const std::vector<std::uint32_t>& patches);

/// The same of parts of patches (CellStore::parts).
[[nodiscard]] SidedList parts_by_cull_mode(const PatchStore& store, const View& view,
                                           const std::vector<std::uint32_t>& parts);

/// Which of the patches' shares of the seams (SeamStore::seams) a view shows with both sides.
[[nodiscard]] SidedList seams_by_cull_mode(const PatchStore& store, const View& view,
                                           const std::vector<std::uint32_t>& seams);

/// While it lives, OpenGL leaves triangles that face away out, if it is `wanted`.
class CulledFaces {
 public:
  CulledFaces(const Gl& gl, bool wanted) : gl_(gl), wanted_(wanted) {
    if (wanted_) gl_.Enable(GL_CULL_FACE);
  }
  ~CulledFaces() {
    if (wanted_) gl_.Disable(GL_CULL_FACE);
  }
  CulledFaces(const CulledFaces&) = delete;
  CulledFaces& operator=(const CulledFaces&) = delete;

 private:
  const Gl& gl_;
  bool wanted_;
};

}  // namespace relief

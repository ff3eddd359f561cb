// Which models a frame draws without what faces away from the eye.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/instance.h"
#include "common/patch.h"
#include "renderer/gl/functions.h"
#include "renderer/settings.h"
#include "renderer/view/view.h"

namespace relief {

struct PatchStore;

/// Where a closed surface stands.
struct Body {
  Bounds box;  ///< about all that is drawn of it, model frame
  Transform where;
};

/// Whether a view shows a closed surface from outside and nothing cuts it: then its front hides its
/// back.
[[nodiscard]] bool sees_from_outside(const View& view, const Body& body);

/// The box about the samples of some patches and what their splats reach beyond; model frame.
[[nodiscard]] Bounds box_about(std::span<const Patch> patches);

/// Whether some model is known to be closed.
[[nodiscard]] bool has_closed_bodies(const PatchModel& model);

/// The sides that a picture shows. What is semi-transparent is looked through, at its back sides
/// too, unless the settings want the front.
[[nodiscard]] CullMode cull_mode_of(const RenderSettings& settings);

/// Whether a picture may leave back sides out. `closed`: has_closed_bodies.
[[nodiscard]] bool may_hide_backs(const RenderSettings& settings, bool closed);

/// Whether some view asks where closed surfaces stand.
[[nodiscard]] bool make_use_of_bodies(std::span<const View> views);

/// What a frame draws, in its order: of these things both sides, and of those the front alone.
struct SidedList {
  std::vector<std::uint32_t> both;
  std::vector<std::uint32_t> front;
};

/// Which patches of the store a view shows with both sides.
[[nodiscard]] SidedList by_cull_mode(const PatchStore& store, const View& view,
                                     const std::vector<std::uint32_t>& patches);

/// The same of parts of patches (CellStore::parts).
[[nodiscard]] SidedList parts_by_cull_mode(const PatchStore& store, const View& view,
                                           const std::vector<std::uint32_t>& parts);

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

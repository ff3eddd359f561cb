// Which models a frame draws without what faces away from the eye.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/instance.h"
#include "common/patch.h"
#include "renderer/settings.h"
#include "renderer/view/view.h"

namespace relief {

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

/// The sides that an image shows. What is semi-transparent is looked through, at its back sides
/// too, unless the settings want the front.
[[nodiscard]] CullMode cull_mode_of(const RenderSettings& settings);

/// Whether an image may leave back sides out. `closed`: has_closed_bodies.
[[nodiscard]] bool may_hide_backs(const RenderSettings& settings, bool closed);

/// Whether some view asks where closed surfaces stand.
[[nodiscard]] bool make_use_of_bodies(std::span<const View> views);

}  // namespace relief

// The camera as shaders take it.
#pragma once

#include "common/scene/light.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/view.h"
#include "shaders/include/shared.h"

namespace relief {

/// The camera relative to a patch.
[[nodiscard]] shared::PatchView view_patch(const View& view, const StoredPatch& patch);

/// What all patches of a frame share. `largest_sprite` in pixels.
[[nodiscard]] shared::Frame make_frame(const View& view, double largest_sprite,
                                       const Lights& lights);

}  // namespace relief

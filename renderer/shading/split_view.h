// Which pictures can have the split view (Material::Split).
#pragma once

#include "common/error.h"
#include "renderer/render.h"

namespace relief {

/// Fails if some material is Split and the picture's engine does not know the places on patches
/// that it shows. `on_patches`: what is drawn are patches, or triangles that stand for them.
Status check_split_view(const RenderSettings& settings, bool on_patches);

}  // namespace relief

// The shader variant that a scene needs. The bits and their costs: shaders/include/shared.h.
#pragma once

#include <cstdint>

#include "renderer/patch_store.h"
#include "renderer/render.h"
#include "shaders/include/shared.h"

namespace relief::onepass {

/// The feature bits of a scene.
[[nodiscard]] inline std::uint32_t features_of(const RenderSettings& settings, bool has_colours) {
  const bool coloured = has_colours && settings.material != Material::Mirror;
  return (settings.primitive == Primitive::Sprite ? RELIEF_FEATURE_SPRITE : 0U) |
         (settings.primitive == Primitive::Cell ? RELIEF_FEATURE_CELL : 0U) |
         (settings.interpolation == Interpolation::Corrected ? RELIEF_FEATURE_CORRECTED : 0U) |
         (coloured ? RELIEF_FEATURE_COLOURS : 0U) |
         (settings.material == Material::Lit ? RELIEF_FEATURE_LIT : 0U) |
         (settings.material == Material::Mirror ? RELIEF_FEATURE_MIRROR : 0U) |
         (settings.outputs.normal ? RELIEF_FEATURE_OUT_NORMAL : 0U) |
         (settings.outputs.depth ? RELIEF_FEATURE_OUT_DEPTH : 0U) |
         (settings.outputs.uv ? RELIEF_FEATURE_OUT_UV : 0U) |
         (settings.outputs.patch_id ? RELIEF_FEATURE_OUT_PATCH : 0U);
}

/// What those features read.
[[nodiscard]] inline StoreNeeds needs_of(std::uint32_t features) {
  constexpr std::uint32_t kWithNormals =
      RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_OUT_NORMAL;
  const bool cells = (features & RELIEF_FEATURE_CELL) != 0;
  StoreNeeds needs;
  needs.splats = !cells;
  needs.heights = !cells && (features & RELIEF_FEATURE_CORRECTED) != 0;
  needs.cells = cells;
  needs.normals = (features & kWithNormals) != 0;
  needs.colours = (features & RELIEF_FEATURE_COLOURS) != 0;
  return needs;
}

}  // namespace relief::onepass

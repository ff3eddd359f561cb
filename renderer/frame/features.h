// The shader variant that a scene needs. The bits and their costs: shaders/include/shared.h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "renderer/settings.h"
#include "renderer/shading/lighting.h"
#include "renderer/shading/materials.h"
#include "renderer/store/map_upload.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/cull_mode.h"
#include "shaders/include/shared.h"

namespace relief {

/// Those of the materials, and of the lights where one of them is lit.
[[nodiscard]] inline std::uint32_t material_features(const RenderSettings& settings) {
  const std::vector<MaterialSettings> materials = materials_of(settings);
  const bool mixed = materials.size() > 1;
  std::uint32_t features = mixed ? RELIEF_FEATURE_MIXED : 0U;
  for (const MaterialSettings& material : materials) {
    if (material.kind == Material::Lit) features |= RELIEF_FEATURE_LIT;
    if (material.kind == Material::Mirror) features |= RELIEF_FEATURE_MIRROR;
    if (material.kind == Material::Glass) features |= RELIEF_FEATURE_GLASS;
    if (material.kind == Material::Split)
      features |= RELIEF_FEATURE_SPLIT | RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR;
    if (mixed && roughness_of(material) > 0.0F) features |= RELIEF_FEATURE_ROUGH;
  }
  if ((features & RELIEF_FEATURE_LIT) == 0) return features;
  const std::vector<Light>& lights = settings.lights.list;
  const bool points = std::any_of(lights.begin(), lights.end(), [](const Light& light) {
    return light.kind == LightKind::Point;
  });
  return features | (points ? RELIEF_FEATURE_POINT_LIGHTS : 0U) |
         static_cast<std::uint32_t>(count_lights(settings.lights)) << RELIEF_LIGHTS_SHIFT;
}

/// What maps a model has beside the normals that all have.
struct ModelMaps {
  bool colours = false;
  bool fine_colours = false;  ///< has_fine_colours
  bool fine_normals = false;  ///< has_fine_normals
  bool closed = false;        ///< has_closed_bodies

  ModelMaps(bool has_colours)  // NOLINT: implicit on purpose, most have no others
      : colours(has_colours) {}
  explicit ModelMaps(const PatchModel& model)
      : colours(model.has_colours),
        fine_colours(model.has_colours && has_fine_colours(model)),
        fine_normals(has_fine_normals(model)),
        closed(has_closed_bodies(model)) {}
};

/// Whether models that are seen small enough are drawn from afar (proxy.h): where levels of
/// detail are, but not with semi-transparent surfaces, whose layers only cells find, nor beside
/// glass with two interfaces, whose far side only they find, nor in a split view, which shows
/// samples.
[[nodiscard]] inline bool draws_from_afar(const RenderSettings& settings) {
  return settings.primitive == Primitive::Cell && pixels_per_sample_of(settings) >= 1.0 &&
         !is_transparent(settings) && !has_two_interfaces(settings) &&
         !uses(settings, Material::Split);
}

/// Whether features read normals.
[[nodiscard]] inline bool needs_normals(std::uint32_t features) {
  return (features & (RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS |
                      RELIEF_FEATURE_OUT_NORMAL)) != 0;
}

/// The feature bits of a picture that any engine on OpenGL can have.
[[nodiscard]] inline std::uint32_t scene_features(const RenderSettings& settings, ModelMaps maps) {
  const bool coloured =
      maps.colours && (uses(settings, Material::Unlit) || uses(settings, Material::Lit) ||
                       uses(settings, Material::Split));
  const std::uint32_t shading =
      material_features(settings) | (settings.outputs.normal ? RELIEF_FEATURE_OUT_NORMAL : 0U);
  return shading | (settings.camera.is_orthographic() ? RELIEF_FEATURE_ORTHOGRAPHIC : 0U) |
         (settings.primitive == Primitive::Sprite ? RELIEF_FEATURE_SPRITE : 0U) |
         (settings.primitive == Primitive::Sprite && may_hide_backs(settings, maps.closed)
              ? RELIEF_FEATURE_FRONT
              : 0U) |
         (coloured ? RELIEF_FEATURE_COLOURS : 0U) |
         (coloured && maps.fine_colours ? RELIEF_FEATURE_FINE_COLOURS : 0U) |
         (needs_normals(shading) && maps.fine_normals ? RELIEF_FEATURE_FINE_NORMALS : 0U) |
         (settings.outputs.depth ? RELIEF_FEATURE_OUT_DEPTH : 0U) |
         (settings.outputs.uv ? RELIEF_FEATURE_OUT_UV : 0U) |
         (settings.outputs.patch_id ? RELIEF_FEATURE_OUT_PATCH : 0U);
}

/// What those features read.
[[nodiscard]] inline StoreNeeds needs_of(std::uint32_t features) {
  const bool cells = (features & RELIEF_FEATURE_CELL) != 0;
  StoreNeeds needs;
  needs.splats = !cells;
  needs.heights = !cells && (features & RELIEF_FEATURE_CORRECTED) != 0;
  needs.cells = cells;
  needs.normals = needs_normals(features);
  needs.colours = (features & RELIEF_FEATURE_COLOURS) != 0;
  needs.masks = (features & RELIEF_FEATURE_MASKED) != 0;
  needs.sources = (features & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH)) != 0;
  needs.bodies = (features & RELIEF_FEATURE_TWO_INTERFACES) != 0;
  return needs;
}

/// What the views read together; `features_of` gives an engine's feature bits of one of them.
template <class FeaturesOf>
[[nodiscard]] StoreNeeds needs_of(std::span<const RenderSettings> views, ModelMaps maps,
                                  const FeaturesOf& features_of) {
  StoreNeeds needs;
  for (const RenderSettings& settings : views) {
    const StoreNeeds more = needs_of(features_of(settings, maps));
    needs.splats = needs.splats || more.splats;
    needs.heights = needs.heights || more.heights;
    needs.cells = needs.cells || more.cells;
    needs.normals = needs.normals || more.normals;
    needs.colours = needs.colours || more.colours;
    needs.masks = needs.masks || more.masks;
    needs.sources = needs.sources || more.sources;
    needs.bodies = needs.bodies || more.bodies;
  }
  return needs;
}

}  // namespace relief

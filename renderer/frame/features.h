// The shader variant that a scene needs. The bits and their costs: shaders/include/shared.h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "renderer/gl/shader/features.h"
#include "renderer/settings.h"
#include "renderer/shading/lighting.h"
#include "renderer/shading/materials.h"
#include "renderer/store/maps/map_upload.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/cull_mode.h"
#include "shaders/include/shared.h"

namespace relief {

/// Those of the materials, and of the lights where one of them is lit.
[[nodiscard]] inline Features material_features(const RenderSettings& settings) {
  const std::vector<MaterialSettings> materials = materials_of(settings);
  const bool mixed = materials.size() > 1;
  Features features = mixed ? RELIEF_FEATURE_MIXED : 0U;
  for (const MaterialSettings& material : materials) {
    if (material.kind == Material::Lit) features |= RELIEF_FEATURE_LIT;
    if (material.kind == Material::Mirror) features |= RELIEF_FEATURE_MIRROR;
    if (material.kind == Material::Glass) features |= RELIEF_FEATURE_GLASS;
    if (material.kind == Material::Split)
      features |= RELIEF_FEATURE_SPLIT | RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR;
    if (mixed && roughness_of(material) > 0.0F) features |= RELIEF_FEATURE_ROUGH;
  }
  if (!features.has(RELIEF_FEATURE_LIT)) return features;
  const std::vector<Light>& lights = settings.lights.list;
  const bool points = std::any_of(lights.begin(), lights.end(), [](const Light& light) {
    return light.kind == LightKind::Point;
  });
  if (settings.lights.from_environment && uses(settings, Material::Lit))
    features |= RELIEF_FEATURE_ENVIRONMENT_LIGHT;
  features.lights = static_cast<std::uint32_t>(count_lights(settings.lights));
  return features | (points ? RELIEF_FEATURE_POINT_LIGHTS : 0U);
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
[[nodiscard]] inline bool needs_normals(Features features) {
  return features.has(RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS |
                      RELIEF_FEATURE_OUT_NORMAL);
}

/// The feature bits of an image that any engine on OpenGL can have.
[[nodiscard]] inline Features scene_features(const RenderSettings& settings, ModelMaps maps) {
  const bool coloured =
      maps.colours && (uses(settings, Material::Unlit) || uses(settings, Material::Lit) ||
                       uses(settings, Material::Split));
  const Features shading =
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
[[nodiscard]] inline StoreNeeds needs_of(Features features) {
  const bool cells = features.has(RELIEF_FEATURE_CELL);
  StoreNeeds needs;
  needs.splats = !cells;
  needs.heights = !cells && features.has(RELIEF_FEATURE_CORRECTED);
  needs.cells = cells;
  needs.normals = needs_normals(features);
  needs.colours = features.has(RELIEF_FEATURE_COLOURS);
  needs.masks = features.has(RELIEF_FEATURE_MASKED);
  needs.sources = features.has(RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH);
  needs.bodies = features.has(RELIEF_FEATURE_TWO_INTERFACES);
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

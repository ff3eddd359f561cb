#include "renderer/costs/removable_features.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "renderer/frame/features.h"
#include "renderer/shading/materials.h"
#include "renderer/view/cull_mode.h"
#include "renderer/view/texels_in_view.h"

namespace relief {
namespace {

/// Calls `change` with each material of the settings.
template <class Change>
void change_materials(RenderSettings& settings, const Change& change) {
  MaterialSettings only{settings.material, settings.constants};
  change(only);
  settings.material = only.kind;
  settings.constants = only.constants;
  for (MaterialSettings& material : settings.materials) change(material);
}

/// Turns all materials of a kind into the stored colour; they stay as opaque as they are.
void make_unlit(Material kind, RenderSettings& settings) {
  change_materials(settings, [kind](MaterialSettings& material) {
    if (material.kind == kind) material.kind = Material::Unlit;
  });
}

template <class Has>
bool some_material(const RenderSettings& settings, const Has& has) {
  return std::ranges::any_of(materials_of(settings), has);
}

bool is_rough_mirror(const MaterialSettings& material) {
  return material.kind == Material::Mirror && material.constants.roughness > 0.0F;
}

bool shows_colours(const RenderSettings& settings, const PatchModel& model) {
  return scene_features(settings, ModelMaps(model)).has(RELIEF_FEATURE_COLOURS);
}

/// Halves the maps of patches until they have at most so many texels a cell.
template <class Map>
void coarsen_maps(Map Patch::*map, std::uint32_t most, PatchModel& model) {
  for (Patch& patch : model.patches) {
    while (!(patch.*map).empty() && (patch.*map).scale > most && (patch.*map).scale % 2 == 0)
      patch.*map = halved(patch.*map);
  }
}

bool hides_backs(const RenderSettings& settings, const PatchModel& model) {
  return may_hide_backs(settings, has_closed_bodies(model));
}

constexpr std::array kFeatures{
    RemovableFeature{.name = "colours",
                     .instead = "grey",
                     .is_used = shows_colours,
                     .leave_out_of =
                         [](PatchModel& model) {
                           model.has_colours = false;
                           for (Patch& patch : model.patches) patch.colours = {};
                         }},
    RemovableFeature{
        .name = "fine colours",
        .instead = "2 texels a cell or fewer",
        .is_used =
            [](const RenderSettings& settings, const PatchModel& model) {
              return shows_colours(settings, model) && has_fine_colours(model);
            },
        .leave_out_of = [](PatchModel& model) { coarsen_maps(&Patch::colours, 2, model); }},
    RemovableFeature{.name = "light",
                     .instead = "the stored colour",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return uses(settings, Material::Lit); },
                     .leave_out =
                         [](RenderSettings& settings) {
                           make_unlit(Material::Lit, settings);
                           settings.lights.from_environment = false;
                         }},
    RemovableFeature{
        .name = "light of the environment",
        .instead = "three lights at the camera",
        .is_used =
            [](const RenderSettings& settings, const PatchModel&) {
              return settings.lights.from_environment && uses(settings, Material::Lit);
            },
        .leave_out = [](RenderSettings& settings) { settings.lights.from_environment = false; }},
    RemovableFeature{
        .name = "fine normals",
        .instead = "1 texel a cell",
        .is_used =
            [](const RenderSettings& settings, const PatchModel& model) {
              return scene_features(settings, ModelMaps(model)).has(RELIEF_FEATURE_FINE_NORMALS);
            },
        .leave_out_of = [](PatchModel& model) { coarsen_maps(&Patch::normals, 1, model); }},
    RemovableFeature{
        .name = "reflection",
        .instead = "mirrors show the stored colour",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return uses(settings, Material::Mirror); },
        .leave_out = [](RenderSettings& settings) { make_unlit(Material::Mirror, settings); }},
    RemovableFeature{
        .name = "rough reflection",
        .instead = "smooth mirrors",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return some_material(settings, is_rough_mirror); },
        .leave_out =
            [](RenderSettings& settings) {
              change_materials(settings, [](MaterialSettings& material) {
                if (is_rough_mirror(material)) material.constants.roughness = 0.0F;
              });
            }},
    RemovableFeature{
        .name = "refraction",
        .instead = "glass shows the stored colour",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return uses(settings, Material::Glass); },
        .leave_out = [](RenderSettings& settings) { make_unlit(Material::Glass, settings); }},
    RemovableFeature{.name = "second interface",
                     .instead = "light is refracted where it enters only",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return has_two_interfaces(settings); },
                     .leave_out =
                         [](RenderSettings& settings) {
                           change_materials(settings, [](MaterialSettings& material) {
                             material.constants.interfaces = 1;
                           });
                         }},
    RemovableFeature{.name = "transparency",
                     .instead = "opaque surfaces",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return is_transparent(settings); },
                     .leave_out =
                         [](RenderSettings& settings) {
                           change_materials(settings, [](MaterialSettings& material) {
                             material.constants.opacity = 1.0F;
                           });
                         }},
    RemovableFeature{
        .name = "environment behind",
        .instead = "a colour",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return has_backdrop(settings); },
        .leave_out = [](RenderSettings& settings) { settings.shows_environment = false; }},
    RemovableFeature{
        .name = "corrected interpolation",
        .instead = "direct interpolation",
        .is_used =
            [](const RenderSettings& settings, const PatchModel&) {
              return settings.engine == "onepass" && settings.primitive != Primitive::Cell &&
                     settings.interpolation == Interpolation::Corrected;
            },
        .leave_out =
            [](RenderSettings& settings) { settings.interpolation = Interpolation::Direct; }},
    RemovableFeature{
        .name = "clip partners",
        .instead = "whole discs",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return settings.clip.rule != ClipRule::Off; },
        .leave_out =
            [](RenderSettings& settings) {
              settings.clip.rule = ClipRule::Off;
              settings.outputs.clip = false;
            }},
    RemovableFeature{
        .name = "levels of detail",
        .instead = "the finest level",
        .is_used = [](const RenderSettings& settings,
                      const PatchModel&) { return pixels_per_sample_of(settings) > 0.0; },
        .leave_out = [](RenderSettings& settings) { settings.pixels_per_sample = 0.0; }},
    RemovableFeature{.name = "culling of backs",
                     .instead = "both sides",
                     .is_used = hides_backs,
                     .leave_out = [](RenderSettings& settings) { settings.cull = CullMode::None; }},
    RemovableFeature{.name = "samples per pixel",
                     .instead = "1",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return settings.samples > 1; },
                     .leave_out = [](RenderSettings& settings) { settings.samples = 1; }},
    RemovableFeature{.name = "outputs beside colour",
                     .instead = "",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return has_any(settings.outputs); },
                     .leave_out = [](RenderSettings& settings) { settings.outputs = {}; }},
    RemovableFeature{.name = "eye-dome lighting",
                     .instead = "",
                     .is_used = [](const RenderSettings& settings,
                                   const PatchModel&) { return settings.eye_dome > 0.0; },
                     .leave_out = [](RenderSettings& settings) { settings.eye_dome = 0.0; }},
};

}  // namespace

std::span<const RemovableFeature> removable_features() {
  return kFeatures;
}

}  // namespace relief

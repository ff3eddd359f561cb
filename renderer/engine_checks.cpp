#include "renderer/engine_checks.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "renderer/shading/materials.h"
#include "renderer/volume/surfaces_beside.h"

namespace relief {
namespace {

/// "a, b and c"
std::string listed(const std::vector<std::string>& names, std::string_view last) {
  std::string list;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) list += k + 1 == names.size() ? fmt::format(" {} ", last) : ", ";
    list += names[k];
  }
  return list;
}

/// The engines that can, as "engine onepass with primitive cell, engine ewa and engine raytrace".
std::string engines_with(Support EngineCapabilities::*what, std::span<const EngineEntry> among) {
  std::vector<std::string> names;
  for (const EngineEntry& engine : among) {
    const Support support = engine.capabilities.*what;
    if (!support.any()) continue;
    std::vector<std::string> primitives;
    for (const Named<Primitive>& primitive : kPrimitives) {
      if (support.depends() && support.has(primitive.value))
        primitives.emplace_back(primitive.name);
    }
    names.push_back("engine " + engine.name);
    if (!primitives.empty()) names.back() += " with primitive " + listed(primitives, "or");
  }
  return listed(names, "and");
}

/// Splats of one surface overlap, so that engines that splat on the GPU can't blend it once.
Status check_opacity(const EngineEntry& engine, const RenderSettings& settings,
                     std::span<const EngineEntry> among) {
  if (!is_transparent(settings) || engine.capabilities.transparency.has(settings.primitive))
    return {};
  return make_error("a material's opacity is below 1, which {} draw; choose one of them",
                    engines_with(&EngineCapabilities::transparency, among));
}

/// What leaves a body is known where one surface of it is in front and one behind.
Status check_interfaces(const EngineEntry& engine, const RenderSettings& settings,
                        std::span<const EngineEntry> among) {
  if (!has_two_interfaces(settings)) return {};
  if (!engine.capabilities.two_interfaces.has(settings.primitive)) {
    return make_error(
        "a glass has two interfaces, which {} draw; choose one of them, or one interface",
        engines_with(&EngineCapabilities::two_interfaces, among));
  }
  if (is_transparent(settings)) {
    return make_error(
        "glass with two interfaces and a material whose opacity is below 1 can't be in one image; "
        "choose one interface, or an opacity of 1");
  }
  return {};
}

/// Of engines that clip nothing, the output would be empty.
Status check_clip_output(const EngineEntry& engine, const RenderSettings& settings,
                         std::span<const EngineEntry> among) {
  if (!settings.outputs.clip || engine.capabilities.clips_splats) return {};
  std::vector<std::string> names;
  for (const EngineEntry& other : among) {
    if (other.capabilities.clips_splats) names.push_back("engine " + other.name);
  }
  return make_error("engine {} has no output clip, which {} have; choose one of them", engine.name,
                    listed(names, "and"));
}

}  // namespace

Status check_split_view(const EngineEntry& engine, const RenderSettings& settings, ModelForm form,
                        std::span<const EngineEntry> among) {
  if (!uses(settings, Material::Split)) return {};
  if (!engine.capabilities.split_view.any()) {
    return make_error(
        "engine {} can't show the material split, because its splats blend; choose one of {}",
        engine.name, engines_with(&EngineCapabilities::split_view, among));
  }
  if (form != ModelForm::Patches) {
    return make_error(
        "engine {} can't show the material split of a mesh's own triangles, which have no samples; "
        "convert the mesh to a .relief file first",
        engine.name);
  }
  return {};
}

Status check_engine(const EngineEntry& engine, const RenderSettings& settings,
                    const RenderModel& model, std::span<const EngineEntry> among) {
  RELIEF_TRY(check_clip_output(engine, settings, among));
  const std::optional<ModelForm> form = form_for(engine, model);
  if (!form) return make_error("engine {} can't draw this model in any of its forms", engine.name);
  const EngineEntry* const beside = find_engine(engine.surfaces_by, among);
  if (beside != nullptr && has_surfaces(model)) {
    if (is_transparent(settings)) {
      return make_error(
          "a material's opacity is below 1; surfaces beside volumes and 3D Gaussians are opaque: "
          "choose an opacity of 1");
    }
    return check_engine(*beside, settings, model, among);
  }
  RELIEF_TRY(check_opacity(engine, settings, among));
  RELIEF_TRY(check_interfaces(engine, settings, among));
  return check_split_view(engine, settings, *form, among);
}

}  // namespace relief

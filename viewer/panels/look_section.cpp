// The section "Look": what the surface is made of, and what is behind it.
#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/image/srgb.h"
#include "renderer/engine_registry.h"
#include "renderer/shading/materials.h"
#include "viewer/choices/material_choices.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

/// Of kExposures and kEyeDomes, what a slider sets finely.
constexpr NumberChoice kFineExposures{-5.0, 5.0};
constexpr NumberChoice kFineEyeDomes{0.0, 5.0};

bool opacity_row(SceneSettings& look) {
  return number_row(
      {"Opacity", "Share of the background that the surface covers", kOpacities, 1.0, "%.2f"},
      look.opacity);
}

bool roughness_row(SceneSettings& look, Preferences& preferences) {
  if (!number_row({"Roughness",
                   "Near 0 it is smooth",
                   {kRoughnessStep, kRoughnesses.max},
                   kFirstRoughness,
                   "%.2f"},
                  look.roughness))
    return false;
  const float chosen =
      stepped_roughness(static_cast<float>(look.roughness.value_or(kFirstRoughness)));
  const bool is_other = preferences.material.roughness != chosen;
  look.roughness = preferences.material.roughness = chosen;
  return is_other;
}

bool absorption_row(SceneSettings& look) {
  begin_row("Absorption",
            "Light that is lost along the body's diameter, as exponents for red, green and blue");
  glm::vec3 value = look.absorption.value_or(glm::vec3(0.0F));
  const bool moved =
      ImGui::DragFloat3("##absorption", &value.x, 0.02F, static_cast<float>(kAbsorptions.min),
                        static_cast<float>(kAbsorptions.max), "%.2f", ImGuiSliderFlags_AlwaysClamp);
  const bool takes_back = ImGui::IsItemClicked(ImGuiMouseButton_Right);
  if (takes_back)
    look.absorption.reset();
  else if (moved)
    look.absorption = value;
  return moved || takes_back;
}

bool glass_rows(const EngineCapabilities& can, const RenderSettings& drawn, SceneSettings& look,
                Preferences& preferences) {
  bool changes = number_row({"Refraction", "Index of refraction, relative to the surroundings",
                             kRefractiveIndices, MaterialConstants().ior, "%.2f"},
                            look.ior);
  changes |= absorption_row(look);
  const MaterialConstants made = material_of(look).constants;
  preferences.material.ior = made.ior;
  preferences.material.absorption = made.absorption;
  if (!can.two_interfaces.has(drawn.primitive)) return changes;
  const std::vector<std::string> names{"1, where light enters", "2, also where it leaves"};
  const auto chosen = choice_row("Interfaces", "Surfaces that refract light", names,
                                 static_cast<std::size_t>(look.interfaces.value_or(1) - 1));
  if (!chosen) return changes;
  look.interfaces = static_cast<int>(*chosen) + 1;
  if (look.interfaces == 2) look.opacity.reset();  // the two do not go together
  return true;
}

/// Returns whether the look has changed.
bool material_rows(const RenderSettings& drawn, SceneSettings& look, Preferences& preferences) {
  const EngineEntry* const engine = find_engine(drawn.engine);
  const EngineCapabilities can = engine == nullptr ? EngineCapabilities() : engine->capabilities;
  std::vector<MaterialChoice> choices = material_choices();
  if (!can.split_view.any())
    std::erase_if(choices, [](const MaterialChoice& c) { return c.kind == Material::Split; });
  std::vector<std::string> names;
  names.reserve(choices.size());
  for (const MaterialChoice& choice : choices) names.push_back(capitalised(choice.name));
  const auto current =
      std::find(choices.begin(), choices.end(), choice_of(drawn.material, drawn.constants));
  const auto chosen =
      choice_row("Material",
                 "Unlit shows the stored colours; split shows quarters: lit, mirror, "
                 "both, and the samples",
                 names,
                 current == choices.end()
                     ? std::nullopt
                     : std::optional(static_cast<std::size_t>(current - choices.begin())));
  bool changes = chosen.has_value();
  if (chosen) choose_material(look, choices[*chosen], preferences.material);
  if (drawn.material == Material::Mirror && drawn.constants.roughness > 0.0F)
    changes |= roughness_row(look, preferences);
  if (drawn.material == Material::Glass) changes |= glass_rows(can, drawn, look, preferences);
  if (can.transparency.has(drawn.primitive) && !has_two_interfaces(drawn))
    changes |= opacity_row(look);
  return changes;
}

bool background_rows(const RenderSettings& drawn, SceneSettings& look) {
  const bool has_environment = !drawn.environment.empty();
  const std::vector<std::string> names{has_environment ? "Environment" : "Grey", "Colour"};
  const auto chosen = choice_row("Background", nullptr, names, look.background ? 1U : 0U);
  if (chosen == 0U) look.background.reset();
  if (chosen == 1U) look.background = Background{drawn.background.value_or(glm::vec3(0.0F))};
  if (!look.background) return chosen.has_value();
  glm::vec3 colour = look.background->colour.value_or(glm::vec3(0.0F));
  if (!colour_row("", nullptr, colour)) return chosen.has_value();
  look.background = Background{colour};
  return true;
}

bool eye_dome_row(const RenderSettings& drawn, bool has_kernels, SceneSettings& look) {
  // There is no depth of other surfaces, and none of kernels.
  const bool is_opaque = !is_transparent(drawn) && !has_kernels;
  ImGui::BeginDisabled(!is_opaque);
  const bool changes =
      number_row({"Eye dome",
                  is_opaque ? "Eye-dome lighting: what lies behind its neighbours is darker"
                            : "Eye-dome lighting shades opaque surfaces only",
                  kFineEyeDomes, 0.0, "%.2f"},
                 look.eye_dome);
  ImGui::EndDisabled();
  return changes;
}

}  // namespace

void show_look(const PanelContext& panel) {
  Session& session = panel.session;
  if (session.scene == nullptr) return show_faint("There is no surface yet.");
  SceneSettings& look = edited_look(session);
  const auto drawn = settings_of(session, look);
  if (!drawn) return show_faint_wrapped(drawn.error().message.c_str());
  bool changes = false;
  if (drawn->materials.empty())
    changes |= material_rows(*drawn, look, session.preferences);
  else
    show_faint_wrapped("The models of this scene have materials of their own.");
  changes |= background_rows(*drawn, look);
  changes |= number_row(
      {"Exposure", "Stops: light is multiplied by 2 to this power", kFineExposures, 0.0, "%+.2f"},
      look.exposure);
  changes |= eye_dome_row(*drawn, session.scene->has_kernels(), look);
  session.look_changed |= changes;
  if (ImGui::Button("Reset look")) {
    look = session.first_look;
    forget_camera(look);
    session.look_changed = true;
  }
  help_for_last(
      "The look that the window began with. A right click on a slider resets that alone.");
}

}  // namespace relief

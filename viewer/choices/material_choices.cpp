#include "viewer/choices/material_choices.h"

#include <algorithm>
#include <cmath>

namespace relief {

std::vector<MaterialChoice> material_choices() {
  std::vector<MaterialChoice> choices;
  for (const auto& [name, kind] : kMaterials) {
    choices.push_back({std::string(name), kind, false});
    if (kind == Material::Mirror) choices.push_back({"rough " + std::string(name), kind, true});
  }
  return choices;
}

MaterialChoice choice_of(Material kind, const MaterialConstants& constants) {
  const bool is_rough = kind == Material::Mirror && constants.roughness > 0.0F;
  const std::vector<MaterialChoice> choices = material_choices();
  return *std::find_if(choices.begin(), choices.end(), [&](const MaterialChoice& choice) {
    return choice.kind == kind && choice.is_rough == is_rough;
  });
}

void choose_material(SceneSettings& look, const MaterialChoice& choice,
                     const MaterialConstants& remembered) {
  look.material = choice.kind;
  look.roughness.reset();
  if (choice.is_rough)
    look.roughness = remembered.roughness > 0.0F ? remembered.roughness : kFirstRoughness;
  if (choice.kind != Material::Glass) return;
  look.ior = remembered.ior;
  look.absorption = remembered.absorption;
}

float stepped_roughness(float roughness) {
  return std::clamp(kRoughnessStep * std::round(roughness / kRoughnessStep),
                    static_cast<float>(kRoughnesses.min), static_cast<float>(kRoughnesses.max));
}

}  // namespace relief

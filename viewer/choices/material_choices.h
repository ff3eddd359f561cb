// The materials that a user can pick, and what picking one does to a look.
#pragma once

#include <string>
#include <vector>

#include "common/scene/material.h"
#include "common/scene/scene.h"

namespace relief {

/// A kind of material, or a mirror that is rough.
struct MaterialChoice {
  std::string name;
  Material kind = Material::Lit;
  bool is_rough = false;

  bool operator==(const MaterialChoice&) const = default;
};

/// What a rough mirror begins with if no roughness was chosen before.
inline constexpr float kFirstRoughness = 0.3F;

/// Roughnesses are chosen in such steps: each has an environment of its own of up to 16 MB.
inline constexpr float kRoughnessStep = 0.05F;

/// Returns the kinds of kMaterials, and the rough mirror after the mirror.
[[nodiscard]] std::vector<MaterialChoice> material_choices();

/// Returns the choice that a material is.
[[nodiscard]] MaterialChoice choice_of(Material kind, const MaterialConstants& constants);

/// Gives a look this material. `remembered`: what it begins with.
void choose_material(SceneSettings& look, const MaterialChoice& choice,
                     const MaterialConstants& remembered);

/// Returns the nearest roughness of whole steps.
[[nodiscard]] float stepped_roughness(float roughness);

}  // namespace relief

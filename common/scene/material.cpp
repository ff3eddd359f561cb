#include "common/scene/material.h"

namespace relief {

MaterialOverrides overlay_material(MaterialOverrides base, const MaterialOverrides& over) {
  if (over.material) base.material = over.material;
  if (over.ior) base.ior = over.ior;
  if (over.absorption) base.absorption = over.absorption;
  if (over.roughness) base.roughness = over.roughness;
  if (over.opacity) base.opacity = over.opacity;
  if (over.interfaces) base.interfaces = over.interfaces;
  return base;
}

MaterialSettings material_of(const MaterialOverrides& overrides) {
  MaterialSettings settings;
  settings.kind = overrides.material.value_or(settings.kind);
  MaterialConstants& constants = settings.constants;
  constants.ior = static_cast<float>(overrides.ior.value_or(constants.ior));
  constants.absorption = overrides.absorption.value_or(constants.absorption);
  constants.roughness = static_cast<float>(overrides.roughness.value_or(constants.roughness));
  constants.opacity = static_cast<float>(overrides.opacity.value_or(constants.opacity));
  constants.interfaces = overrides.interfaces.value_or(constants.interfaces);
  return settings;
}

}  // namespace relief

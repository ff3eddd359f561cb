#include "common/scene/material.h"

namespace relief {

MaterialWords overlay_material(MaterialWords base, const MaterialWords& over) {
  if (over.material) base.material = over.material;
  if (over.ior) base.ior = over.ior;
  if (over.absorption) base.absorption = over.absorption;
  if (over.roughness) base.roughness = over.roughness;
  if (over.opacity) base.opacity = over.opacity;
  if (over.interfaces) base.interfaces = over.interfaces;
  return base;
}

MaterialSettings material_of(const MaterialWords& words) {
  MaterialSettings settings;
  settings.kind = words.material.value_or(settings.kind);
  MaterialConstants& constants = settings.constants;
  constants.ior = static_cast<float>(words.ior.value_or(constants.ior));
  constants.absorption = words.absorption.value_or(constants.absorption);
  constants.roughness = static_cast<float>(words.roughness.value_or(constants.roughness));
  constants.opacity = static_cast<float>(words.opacity.value_or(constants.opacity));
  constants.interfaces = words.interfaces.value_or(constants.interfaces);
  return settings;
}

}  // namespace relief

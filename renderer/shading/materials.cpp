#include "renderer/shading/materials.h"

#include <algorithm>
#include <cassert>

namespace relief {
namespace {

static_assert(kMaxMaterials == shared::kMaxMaterials);
static_assert(static_cast<int>(Material::Unlit) == shared::kUnlit &&
              static_cast<int>(Material::Lit) == shared::kLit &&
              static_cast<int>(Material::Mirror) == shared::kMirror &&
              static_cast<int>(Material::Glass) == shared::kGlass &&
              static_cast<int>(Material::Split) == shared::kSplit);

}  // namespace

std::vector<MaterialSettings> materials_of(const RenderSettings& settings) {
  const std::vector<MaterialSettings>& all = settings.materials;
  assert(all.size() <= kMaxMaterials && "no more materials than an image has room for");
  if (all.empty()) return {{settings.material, settings.constants}};
  const bool same = std::all_of(all.begin(), all.end(), [&all](const MaterialSettings& material) {
    return material == all.front();
  });
  return same ? std::vector<MaterialSettings>{all.front()} : all;
}

std::vector<std::uint8_t> materials_of_patches(const PatchModel& model,
                                               const std::vector<std::uint32_t>& patches) {
  std::vector<std::uint8_t> materials;
  if (std::all_of(model.patches.begin(), model.patches.end(),
                  [](const Patch& patch) { return patch.material == 0; }))
    return materials;
  materials.reserve(patches.size());
  for (const std::uint32_t patch : patches) materials.push_back(model.patches[patch - 1].material);
  return materials;
}

bool uses(const RenderSettings& settings, Material kind) {
  if (settings.materials.empty()) return settings.material == kind;
  return std::any_of(settings.materials.begin(), settings.materials.end(),
                     [kind](const MaterialSettings& material) { return material.kind == kind; });
}

bool reflects(const RenderSettings& settings) {
  const bool lit = settings.lights.from_environment && uses(settings, Material::Lit);
  return lit || uses(settings, Material::Mirror) || uses(settings, Material::Glass) ||
         uses(settings, Material::Split);
}

bool is_transparent(const RenderSettings& settings) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  return std::any_of(all.begin(), all.end(),
                     [](const MaterialSettings& material) { return is_transparent(material); });
}

bool has_two_interfaces(const RenderSettings& settings) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  return std::any_of(all.begin(), all.end(),
                     [](const MaterialSettings& material) { return has_two_interfaces(material); });
}

float roughness_of(const MaterialSettings& material) {
  const bool mirrors = material.kind == Material::Mirror || material.kind == Material::Split ||
                       material.kind == Material::Lit;
  return mirrors ? material.constants.roughness : 0.0F;
}

std::vector<float> roughnesses_of(const std::vector<MaterialSettings>& materials) {
  std::vector<float> all;
  for (const MaterialSettings& material : materials) {
    const float roughness = roughness_of(material);
    if (roughness > 0.0F && std::find(all.begin(), all.end(), roughness) == all.end())
      all.push_back(roughness);
  }
  return all;
}

shared::MaterialInfo info_of(const MaterialSettings& material,
                             const std::vector<float>& roughnesses) {
  const auto found = std::find(roughnesses.begin(), roughnesses.end(), roughness_of(material));
  const auto layer =
      found == roughnesses.end() ? -1.0F : static_cast<float>(found - roughnesses.begin());
  return {{static_cast<float>(material.kind), material.constants.ior, layer,
           static_cast<float>(material.constants.interfaces)},
          glm::vec4(material.constants.absorption, material.constants.opacity)};
}

}  // namespace relief

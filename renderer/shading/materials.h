// The materials of an image.
#pragma once

#include <vector>

#include "common/patch.h"
#include "renderer/settings.h"
#include "shaders/include/shared.h"

namespace relief {

/// By Patch::material and its like; one if all are the same.
[[nodiscard]] std::vector<MaterialSettings> materials_of(const RenderSettings& settings);

/// The materials of things that lie on patches (`patches`: patch id + 1 of each); empty if all have
/// the first.
[[nodiscard]] std::vector<std::uint8_t> materials_of_patches(
    const PatchModel& model, const std::vector<std::uint32_t>& patches);

/// Whether the image has such a material.
[[nodiscard]] bool uses(const RenderSettings& settings, Material kind);

/// Whether some material reflects the environment.
[[nodiscard]] bool reflects(const RenderSettings& settings);

/// Whether what is behind a surface of this material comes through.
[[nodiscard]] inline bool is_transparent(const MaterialSettings& material) {
  return material.constants.opacity < 1.0F;
}

/// Whether some material is such.
[[nodiscard]] bool is_transparent(const RenderSettings& settings);

/// Whether light is refracted where it leaves a body of this material, too.
[[nodiscard]] inline bool has_two_interfaces(const MaterialSettings& material) {
  return material.kind == Material::Glass && material.constants.interfaces > 1;
}

/// Whether some material is such.
[[nodiscard]] bool has_two_interfaces(const RenderSettings& settings);

/// 0 of what reflects nothing, or all as a smooth mirror. Of a lit surface: kLitRoughness where the
/// environment gives light (lit_by).
[[nodiscard]] float roughness_of(const MaterialSettings& material);

/// The roughnesses above 0 of these materials, each once, in their order: the layers of the rough
/// environments.
[[nodiscard]] std::vector<float> roughnesses_of(const std::vector<MaterialSettings>& materials);

/// The constants as shaders take them. `roughnesses`: the layers that there are.
[[nodiscard]] shared::MaterialInfo info_of(const MaterialSettings& material,
                                           const std::vector<float>& roughnesses);

}  // namespace relief

#include "renderer/shading/shading.h"

#include <algorithm>
#include <cassert>

#include "renderer/shading/lighting.h"
#include "renderer/shading/materials.h"
#include "renderer/view/uniforms.h"
#include "shaders/include/shading.h"
#include "shaders/include/split_view.h"

namespace relief {
namespace {

glm::vec3 shade_glass(const LitMaterial& material, const SeenSurface& surface) {
  const MaterialConstants& constants = material.settings.constants;
  const shared::SplitRay split = shared::split_ray(surface.normal, surface.ray, constants.ior);
  return shared::glass(split, constants.absorption,
                       look_up(material.environment, glm::dvec3(split.reflected)),
                       look_up(material.environment, glm::dvec3(split.refracted)));
}

}  // namespace

Result<Lighting> make_lighting(const RenderSettings& settings, const View& view,
                               EnvironmentCache& environments) {
  Lighting lighting{make_frame(view, 0.0, settings.lights), count_lights(settings.lights), {}};
  if (settings.lights.from_environment) {
    RELIEF_TRY_ASSIGN(const auto irradiance, environments.irradiance(settings.environment));
    std::ranges::copy(irradiance, lighting.frame.irradiance);
  }
  const glm::dmat3 from_world = environment_from_world(settings);
  set_environment(lighting.frame, from_world);
  for (const MaterialSettings& material : materials_of(settings)) {
    lighting.materials.push_back({material});
    if (material.kind == Material::Unlit) continue;
    if (material.kind == Material::Lit && !settings.lights.from_environment) continue;
    RELIEF_TRY_ASSIGN(const auto cube,
                      environments.get(settings.environment, roughness_of(material)));
    lighting.materials.back().environment = {cube, from_world};
  }
  return lighting;
}

const LitMaterial& lit_material(const Lighting& lighting, std::size_t material) {
  const std::vector<LitMaterial>& all = lighting.materials;
  assert((all.size() == 1 || material < all.size()) && "an index into the table of materials");
  return all.size() == 1 ? all.front() : all[material];
}

const MaterialSettings& material_of(const Lighting& lighting, std::size_t material) {
  return lit_material(lighting, material).settings;
}

glm::vec3 shade(const Lighting& lighting, std::size_t material, const SeenSurface& surface) {
  const LitMaterial& own = lit_material(lighting, material);
  const auto facing = [&surface] {
    return shared::facing_normal(surface.normal, surface.ray, surface.from_behind);
  };
  const auto mirror = [&] {
    assert(own.environment.cube != nullptr && "a mirror has something to reflect");
    return look_up(own.environment, glm::dvec3(glm::reflect(surface.ray, facing())));
  };
  const auto lit = [&] {
    const glm::vec3 direct = shared::lit(lighting.frame, lighting.lights, surface.albedo, facing(),
                                         surface.ray, surface.position);
    if (own.settings.kind != Material::Lit || own.environment.cube == nullptr) return direct;
    return direct + shared::lit_by_environment(lighting.frame, surface.albedo, facing(),
                                               surface.ray, mirror());
  };
  switch (own.settings.kind) {
    case Material::Unlit:
      return surface.albedo;
    case Material::Lit:
      return lit();
    case Material::Mirror:
      return mirror();
    case Material::Split:
      return shared::split_view(
          lighting.frame, lighting.frame.ray_along.w > 0.0F ? surface.position : surface.ray, lit(),
          mirror(), shared::stored_samples(surface.uv, surface.patch - 1));
    case Material::Glass:
      assert(own.environment.cube != nullptr && "glass has something to refract");
      return shade_glass(own, surface);
  }
  return surface.albedo;
}

}  // namespace relief

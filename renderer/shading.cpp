#include "renderer/shading.h"

#include <cassert>

#include "shaders/include/shading.h"

namespace relief {

glm::vec3 shade(const Lighting& lighting, std::size_t material, const SeenSurface& surface) {
  assert(material < lighting.materials.size() && "an index into the table of materials");
  const auto facing = [&surface] { return shared::facing_normal(surface.normal, surface.ray); };
  switch (lighting.materials[material]) {
    case Material::Unlit:
      return surface.albedo;
    case Material::Lit:
      return shared::lit(lighting.frame, lighting.lights, surface.albedo, facing(), surface.ray,
                         surface.place);
    case Material::Mirror:
      assert(lighting.cube != nullptr && "a mirror has something to reflect");
      return look_up(*lighting.cube, glm::dvec3(glm::reflect(surface.ray, facing())));
  }
  return surface.albedo;
}

}  // namespace relief

#include "renderer/shading.h"

#include <cassert>

#include "shaders/include/shading.h"

namespace relief {

glm::vec3 shade(Material material, glm::vec3 albedo, glm::vec3 normal, glm::vec3 ray,
                const shared::Frame& frame, const CubeMap* cube) {
  switch (material) {
    case Material::Unlit:
      return albedo;
    case Material::Lit:
      return shared::lit(frame, albedo, shared::facing_normal(normal, ray), ray);
    case Material::Mirror: {
      assert(cube != nullptr && "a mirror has something to reflect");
      const glm::vec3 facing = shared::facing_normal(normal, ray);
      return look_up(*cube, glm::dvec3(glm::reflect(ray, facing)));
    }
  }
  return albedo;
}

}  // namespace relief

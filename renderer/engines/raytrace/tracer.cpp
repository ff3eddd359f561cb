#include "renderer/engines/raytrace/tracer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "renderer/append.h"
#include "renderer/engines/raytrace/glass_path.h"
#include "renderer/engines/raytrace/surface.h"
#include "renderer/shading/materials.h"
#include "shaders/include/shading.h"

namespace relief::raytrace {
namespace {

/// What is behind this much of a surface can't be seen: a 16-bit image has steps of 1.5e-5.
constexpr float kOpaqueEnough = 1.0F - 1e-6F;

bool has_transparent_vertex(const TriangleMesh& mesh) {
  return std::any_of(mesh.colours.begin(), mesh.colours.end(),
                     [](const glm::vec4& colour) { return colour.a < 1.0F; });
}

bool has_transparent_material(const Lighting& lighting) {
  return std::any_of(lighting.materials.begin(), lighting.materials.end(),
                     [](const LitMaterial& m) { return is_transparent(m.settings); });
}

bool has_body(const Lighting& lighting) {
  return std::any_of(lighting.materials.begin(), lighting.materials.end(),
                     [](const LitMaterial& m) { return has_two_interfaces(m.settings); });
}

bool touch(const TriangleMesh& mesh, const Hit& a, const Hit& b) {
  for (const std::uint32_t k : mesh.triangles[a.triangle]) {
    for (const std::uint32_t l : mesh.triangles[b.triangle]) {
      if (mesh.positions[k] == mesh.positions[l]) return true;
    }
  }
  return false;
}

/// Whether a ray crosses one surface here: through an edge or a corner that two triangles share, so
/// that both are met at one depth up to rounding, or where two patches overlap.
bool is_same_crossing(const TriangleMesh& mesh, const Hit& a, const Hit& b) {
  const double behind = b.depth - a.depth;
  return (behind <= 1e-12 * b.depth && touch(mesh, a, b)) ||
         (mesh.layer_gap > 0.0 && behind <= mesh.layer_gap);
}

}  // namespace

Tracer::Tracer(const TriangleMesh& mesh, const EmbreeScene& scene, const View& view,
               Lighting lighting)
    : mesh_(&mesh),
      scene_(&scene),
      view_(view),
      lighting_(std::move(lighting)),
      bodies_(has_body(lighting_) ? bodies_of(mesh) : std::vector<MeshBody>()),
      transparent_(has_transparent_vertex(mesh) || has_transparent_material(lighting_)) {}

SightRay Tracer::ray_at(glm::dvec2 window) const {
  return {ray_start(view_, window), ray_through(view_, window)};
}

glm::vec3 Tracer::shade_body(const Hit& at, const SightRay& ray,
                             const LitMaterial& material) const {
  const MaterialConstants& constants = material.settings.constants;
  const glm::vec3 direction(glm::normalize(ray.direction));
  const shared::SplitRay split = shared::split_ray(normal_at(*mesh_, at), direction, constants.ior);
  const glm::vec3 passed =
      light_through({mesh_, scene_, material.environment, constants, body_at(bodies_, *mesh_, at)},
                    {ray.start + at.depth * ray.direction, glm::dvec3(split.refracted)});
  return glm::mix(passed, look_up(material.environment, glm::dvec3(split.reflected)),
                  split.reflectance);
}

glm::vec4 Tracer::shade_at(const Hit& at, const SightRay& ray) const {
  const glm::vec4 colour = colour_at(*mesh_, at);
  const std::uint8_t material = material_at(*mesh_, at);
  const MaterialSettings& settings = material_of(lighting_, material);
  SeenSurface surface{glm::vec3(colour), normal_at(*mesh_, at),
                      glm::vec3(glm::normalize(ray.direction)),
                      glm::vec3(ray.start + at.depth * ray.direction)};
  surface.from_behind = is_from_behind(*mesh_, at, surface.normal, ray.direction);
  if (settings.kind == Material::Split) {
    surface.uv = uv_at(*mesh_, at);
    surface.patch = patch_at(*mesh_, at);
  }
  // A back side is seen from within: from there light leaves at once.
  if (has_two_interfaces(settings) && glm::dot(surface.normal, surface.ray) <= shared::kBackSide)
    return {shade_body(at, ray, lit_material(lighting_, material)), 1.0F};
  return {shade(lighting_, material, surface), colour.a * settings.constants.opacity};
}

Seen Tracer::blend_along(const SightRay& ray) const {
  std::vector<Hit> met;
  scene_->find_all(ray, met);
  std::sort(met.begin(), met.end(), [](const Hit& a, const Hit& b) {
    return std::tie(a.depth, a.triangle) < std::tie(b.depth, b.triangle);
  });
  Seen seen;
  const Hit* before = nullptr;
  for (const Hit& at : met) {
    if (before != nullptr && is_same_crossing(*mesh_, *before, at)) continue;
    if (before == nullptr) seen.nearest = at;
    before = &at;
    const glm::vec4 surface = shade_at(at, ray);
    seen.colour += (1.0F - seen.colour.a) * surface.a * glm::vec4(glm::vec3(surface), 1.0F);
    if (seen.colour.a >= kOpaqueEnough) break;
  }
  return seen;
}

Seen Tracer::look_through(glm::dvec2 window) const {
  const SightRay ray = ray_at(window);
  if (transparent_) return blend_along(ray);
  const std::optional<Hit> nearest = scene_->find_nearest(ray);
  return {nearest ? shade_at(*nearest, ray) : glm::vec4(0.0F), nearest};
}

std::optional<Hit> Tracer::find_through(glm::dvec2 window) const {
  return scene_->find_nearest(ray_at(window));
}

void Tracer::describe(const Hit& at, FilmPixel& pixel) const {
  pixel.normal = normal_at(*mesh_, at);
  pixel.depth = static_cast<float>(at.depth);
  pixel.uv = uv_at(*mesh_, at);
  pixel.patch = patch_at(*mesh_, at);
}

}  // namespace relief::raytrace

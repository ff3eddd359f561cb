// From a pixel to its outputs.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/frame/targets/film.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/shading/shading.h"
#include "renderer/view/view.h"

namespace relief::raytrace {

/// What a ray sees.
struct Seen {
  glm::vec4 colour{0.0F};      ///< premultiplied; alpha: how much of what is behind is covered
  std::optional<Hit> nearest;  ///< whatever its opacity
};

/// What rays are traced through, and how what they meet is shaded. Mesh, scene and what the
/// lighting names must outlive it; with a glass of two interfaces the scene is one for rays that
/// start anywhere. Threads may share one.
class Tracer {
 public:
  Tracer(const TriangleMesh& mesh, const EmbreeScene& scene, const View& view, Lighting lighting);

  /// What is seen through a window position (pixels from the lower left corner). Opaque meshes show
  /// the nearest triangle. Of others all triangles along the ray count, front to back, each
  /// covering what is behind it by its opacity; none of them bends, tints or shadows. Reflections
  /// are of the environment alone, as in the other engines.
  [[nodiscard]] Seen look_through(glm::dvec2 window) const;

  /// The nearest triangle alone, unshaded.
  [[nodiscard]] std::optional<Hit> find_through(glm::dvec2 window) const;

  /// Fills the outputs beside the colour.
  void describe(const Hit& at, FilmPixel& pixel) const;

 private:
  [[nodiscard]] SightRay ray_at(glm::dvec2 window) const;
  [[nodiscard]] glm::vec3 shade_body(const Hit& at, const SightRay& ray,
                                     const LitMaterial& material) const;
  [[nodiscard]] glm::vec4 shade_at(const Hit& at, const SightRay& ray) const;
  [[nodiscard]] Seen blend_along(const SightRay& ray) const;

  const TriangleMesh* mesh_;
  const EmbreeScene* scene_;
  View view_;
  Lighting lighting_;
  std::vector<MeshBody> bodies_;  ///< of glass with two interfaces, else none
  bool transparent_;              ///< some vertex or material is not opaque
};

}  // namespace relief::raytrace

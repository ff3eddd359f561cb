// Light through a body of glass with two interfaces, followed to where it leaves.
#pragma once

#include <glm/vec3.hpp>

#include "common/scene/material.h"
#include "renderer/engines/raytrace/embree_scene.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/shading/environment/standing_cube.h"

namespace relief::raytrace {

/// How often a ray is reflected within a body at most; what is then left of its light is that of
/// the environment in the direction that it has.
inline constexpr int kMaxReflections = 32;

/// What rays are followed through. Nothing is owned.
struct GlassBody {
  const TriangleMesh* mesh = nullptr;
  const EmbreeScene* scene = nullptr;  ///< built for rays that start anywhere
  StandingCube environment;
  MaterialConstants constants;
  double diameter = 1.0;  ///< world units; what the absorption is over
};

/// The light that comes back along a ray into the body, which begins at its surface. Wherever it
/// meets the surface from within a part of it leaves, by Fresnel's equations, and sees the
/// environment; the rest is reflected and goes on. What has left meets nothing any more, neither
/// this body nor another. Where a mesh is open, so that nothing is met, the ray leaves as it is.
[[nodiscard]] glm::vec3 light_through(const GlassBody& body, SightRay ray);

}  // namespace relief::raytrace

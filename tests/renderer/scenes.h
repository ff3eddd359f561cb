// Synthetic patch models with known surfaces, for the renderer's tests.
#pragma once

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "common/patch.h"

namespace relief::test {

/// What a surface is at the position where a line along a patch's normal meets it.
struct SurfacePoint {
  double height = 0.0;     ///< along the normal, world units from the base plane
  glm::dvec3 normal{0.0};  ///< world, unit
  glm::u8vec3 colour{0};   ///< sRGB
};

/// The surface over a base-plane point (world), or nothing where the patch has a hole.
using Surface = std::function<std::optional<SurfacePoint>(glm::dvec3)>;

/// The base plane of a patch and its grid.
struct Grid {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;
  std::uint32_t width = 2;
  std::uint32_t height = 2;
  std::uint32_t normal_scale = 1;
};

/// Samples a surface over a grid, heights at steps of spacing/1000 unless their range needs more.
/// Normals over holes continue their surroundings, colours are kept if `coloured`.
Patch sample_patch(const Grid& grid, const Surface& surface, bool coloured = false);

/// Axes whose normal is `n`.
glm::dmat3 axes_about(glm::dvec3 n);

/// A model of these patches, with the bounds of their samples.
PatchModel model_of(std::vector<Patch> patches);

/// How a sphere is made of patches.
struct SphereShape {
  glm::dvec3 centre{0.0};
  double radius = 1.0;
  double spacing = 0.05;
  int patches_per_side = 1;  ///< squared, times 6 cube faces
  double overlap_cells = 2.0;
  double bumps = 0.0;  ///< relative depth of the bumps
  double bump_frequency = 6.0;
  bool coloured = false;
};

/// Radius of the (bumpy) sphere in a direction (any length).
double sphere_radius(const SphereShape& shape, glm::dvec3 direction);

/// A closed sphere of overlapping patches, each over the tangent plane in its middle.
PatchModel sphere_model(const SphereShape& shape);

/// The same with colours and a spacing of 0.1: quick to draw.
PatchModel coarse_coloured_sphere();

/// A single square patch of `nodes` nodes a side over the plane z = 0 about the origin whose
/// heights are `height(x, y)` in cells; spacing 1.
PatchModel height_field(std::uint32_t nodes, const std::function<double(double, double)>& height);

}  // namespace relief::test

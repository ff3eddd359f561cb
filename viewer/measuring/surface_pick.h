// Picking: where a ray meets the surface that is reconstructed from patches, in double precision.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/patch.h"
#include "common/seams/seams.h"

namespace relief {

/// What is picked: what OpenGL has drawn at a pixel (Viewport::probe), and the ray through it.
struct PickQuery {
  glm::dvec3 start{0.0};      ///< of the ray, world
  glm::dvec3 direction{0.0};  ///< world, of any length but 0
  /// How far along the ray the surface is, in lengths of `direction`, as the GPU found it. With the
  /// direction of ray_through() (renderer/view/view.h), this is the channel "Z".
  double depth = 0.0;
  /// How high a pixel is at that depth, world units (pixel_at()): rasterisation and levels of
  /// detail move the drawn surface by parts of it.
  double pixel = 0.0;
  /// Which patch the pixel shows, from 0: the channel "patch" less 1. Of a model with instances
  /// (PatchModel::instances) patches are counted through these.
  std::uint32_t patch = 0;
  std::span<const std::uint32_t> others;  ///< patches to try if that one is not there
};

/// A point of the surface.
struct SurfacePoint {
  glm::dvec3 position{0.0};           ///< world
  glm::dvec3 normal{0.0, 0.0, 1.0};   ///< unit, world: the interpolated one, as shading has it
  std::optional<glm::u8vec3> colour;  ///< the stored texel that is nearest, sRGB; none if the patch
                                      ///< has no colours
  std::optional<std::uint32_t> patch;  ///< as in PickQuery; none of kernels, whose normal is 0
  glm::dvec2 uv{0.0};  ///< grid coordinates on the patch, as the output uv has them; texel (i, j)
                       ///< of a map is at (i, j) / scale
  double depth = 0.0;  ///< along the query's ray, in lengths of its direction
};

/// Finds points of a model's surface at full detail, as engine `onepass` draws it with cells: the
/// cells' triangles, the seams between patches that meet, and elsewhere the splats at the borders,
/// corrected as their fragments are (corrected_hit.h). Views of other engines, primitives and
/// levels of detail show the same surface up to some tenths of a cell or of a pixel; a pick there
/// gives the nearest point of this one.
class SurfacePicker {
 public:
  /// Makes the seams of all patches that meet, which takes as long as their upload: better not on
  /// the thread of a window. The model must outlive the picker and not change.
  explicit SurfacePicker(const PatchModel& model);

  /// Returns the point that the pixel shows: where the ray crosses the patch's surface at the depth
  /// of the query. If rounding makes the ray pass the surface by, as at a silhouette, the point of
  /// the surface that is nearest to what the GPU has drawn; if that patch has none near there, the
  /// same for the other patches. Nothing if the depth is not above 0 or there is no surface near
  /// it. Never returns what lies behind the surface that was drawn. Looks at cells near that point
  /// only. Thread-safe.
  [[nodiscard]] std::optional<SurfacePoint> pick(const PickQuery& query) const;

 private:
  [[nodiscard]] std::optional<SurfacePoint> pick_on(std::uint32_t number,
                                                    const PickQuery& query) const;

  const PatchModel* model_;
  std::vector<Seams> seams_;  ///< by run of PatchModel::joined
};

}  // namespace relief

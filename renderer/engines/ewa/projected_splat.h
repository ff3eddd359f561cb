// A point as the camera sees it: its resampling kernel, and the depth of its tangent plane.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "renderer/clip/clip_partners.h"
#include "renderer/engines/ewa/clip_lines.h"
#include "renderer/engines/ewa/resampling_filter.h"
#include "renderer/view/view.h"

namespace relief::ewa {

/// What projecting needs to know about the camera and the settings.
struct SplatCamera {
  View view;
  PixelMapping mapping;
  EwaFilter filter = EwaFilter::Ewa;
  double cutoff = 1.0;
};

[[nodiscard]] SplatCamera make_splat_camera(const View& view, const EwaSettings& settings);

/// The depth of a tangent plane over the image. The inverse depth of a plane is linear in pixels,
/// or orthographic its depth, so that forward differencing is exact.
struct TangentDepth {
  double middle = 1.0;     ///< that quantity at the kernel's centre
  glm::dvec2 change{0.0};  ///< of it, per pixel
  double least = 0.5;      ///< what it ends at: a plane that is seen nearly edge-on runs off to
  double most = 2.0;       ///< infinity or behind the eye within a pixel
  bool inverse = true;     ///< false: orthographic
  double threshold = 0.0;  ///< see Contribution::threshold

  /// The depth at an offset (pixels) from the kernel's centre.
  [[nodiscard]] double at(glm::dvec2 offset) const {
    const double here = middle + change.x * offset.x + change.y * offset.y;
    const double ended = here < least ? least : here > most ? most : here;
    return inverse ? 1.0 / ended : ended;
  }
};

/// The pixels of a box, both ends included.
struct PixelBox {
  std::int64_t left = 0;
  std::int64_t right = -1;
  std::int64_t top = 0;
  std::int64_t bottom = -1;
  [[nodiscard]] bool empty() const { return left > right || top > bottom; }
};

template <class Kernel>
struct ProjectedSplat {
  Kernel kernel;
  TangentDepth depth;
  std::uint32_t index = 0;       ///< in the cloud
  std::uint32_t first_line = 0;  ///< of what clips it, in its chunk
  std::uint32_t line_count = 0;
};

/// The pixels within `limits` whose middles the box about a kernel holds.
template <class Kernel>
[[nodiscard]] PixelBox pixels_of(const Kernel& kernel, const PixelBox& limits);

/// Projects a point (world; `radius` is h). Nothing if it can't be seen:
/// - not before the near plane (orthographic: the eye's), or outside the frustum by more than its
/// kernel reaches (the affine
///   approximation would smear what is beside the eye over the image);
/// - seen edge-on (see map_tangent_plane) or too small to matter (see screen_kernel);
/// - no surface: position, normal or radius not finite, a zero normal, a radius not above 0.
/// A radius above the point's depth, whose kernel fills the image, is taken as the depth. The
/// tangent plane's depth ends at half and twice the point's, or orthographic kEdgeRadii radii from
/// it: a kernel's cut-off is nearer.
template <class Kernel>
[[nodiscard]] std::optional<ProjectedSplat<Kernel>> project_splat(const SplatCamera& camera,
                                                                  glm::dvec3 position,
                                                                  glm::dvec3 normal, double radius);

/// Appends the lines (world) that clip a point of these, which can be seen, as the image shows
/// them.
void project_clip_lines(const SplatCamera& camera, glm::dvec3 position, glm::dvec3 normal,
                        double radius, std::span<const ClipLine> lines,
                        std::vector<ImageLine>& projected);

}  // namespace relief::ewa

// The camera as the renderer uses it: double precision until a patch is relative to the eye.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/bounds.h"
#include "common/scene/camera.h"
#include "common/scene/choices.h"

namespace relief {

/// A rectangle of an image, in its pixels from the lower left corner, and how finely it is drawn.
struct Raster {
  std::uint32_t left = 0;
  std::uint32_t bottom = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t side = 1;  ///< samples along each side of a pixel, a texel of a target each
};

/// A camera with an image size. World units, pixels.
struct View {
  glm::dvec3 eye{0.0};
  glm::dmat3 rotation{1.0};  ///< world to eye directions (x right, y up, z backward)
  glm::dmat4 projection{1.0};
  bool orthographic = false;
  double near = 0.0;
  double far = 0.0;        ///< where depth values end at 0; only of an orthographic camera
  double slope_x = 1.0;    ///< half the image's width and height at distance 1; of an orthographic
  double slope_y = 1.0;    ///< camera at any distance
  glm::dvec2 middle{0.0};  ///< where the image's middle is at distance 1, right and up of the
                           ///< camera's axis: 0 but for a part of an image
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double pixels_per_sample = 0.0;  ///< levels of detail: how far apart samples may be seen
  double proxy_diameter =
      0.0;  ///< 0: no model is drawn from afar; else kProxyDiameter, as often
            ///< as a pixel has samples along a side (renderer/geometry/proxy/proxy.h)
  CullMode cull = CullMode::None;  ///< that are drawn (renderer/view/cull_mode.h)
};

/// What the depth values of a view have to tell apart.
struct DepthNeeds {
  double near = 0.0;     ///< nothing that a perspective camera sees is nearer, world units
  Bounds bounds;         ///< of the model
  double spacing = 0.0;  ///< of its samples
};

/// `near` only bounds what may be in front of the eye: with reversed floating-point depth a small
/// one costs no precision. The depth values of an orthographic camera are linear, so that they are
/// given to the model's bounds, or to what is of them before the plane through the eye: where that
/// is, all engines begin to see. Without bounds (the engines on the CPU) they are of no meaning.
[[nodiscard]] View make_view(const Camera& camera, std::uint32_t width, std::uint32_t height,
                             const DepthNeeds& needs);
[[nodiscard]] inline View make_view(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                    double near) {
  return make_view(camera, width, height, DepthNeeds{near, {}, 0.0});
}

/// What shows a part of the view's image: its pixels are the part's samples.
[[nodiscard]] View view_of_part(const View& whole, const Raster& part);

/// The same camera with an image that shows more: `border` pixels on each side.
[[nodiscard]] View with_border(const View& whole, std::uint32_t border);

/// The direction through a window position (pixels from the lower left corner), world, of length 1
/// along the view axis: the point at depth z is eye + ray_start + z * ray_through.
[[nodiscard]] glm::dvec3 ray_through(const View& view, glm::dvec2 window);

/// Where that ray begins, world, from the eye: 0 but for an orthographic camera.
[[nodiscard]] glm::dvec3 ray_start(const View& view, glm::dvec2 window);

/// How high a pixel is at a depth, world units.
[[nodiscard]] double pixel_at(const View& view, double depth);

/// The depth at which a sphere (world) is nearest to the eye; below 0 behind it.
[[nodiscard]] double nearest_depth(const View& view, glm::dvec3 centre, double radius);

/// How high a pixel is there, world units.
[[nodiscard]] double nearest_pixel(const View& view, glm::dvec3 centre, double radius);

/// How far a position (world) is from the eye, or from the plane through an orthographic one.
[[nodiscard]] double distance_to(const View& view, glm::dvec3 position);

/// Whether a sphere (world) can reach into the image.
[[nodiscard]] bool sees_sphere(const View& view, glm::dvec3 centre, double radius);

}  // namespace relief

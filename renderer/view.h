// The camera as the renderer uses it: double precision until a patch is relative to the eye.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/camera.h"
#include "common/light.h"
#include "shaders/include/shared.h"

namespace relief {

struct StoredPatch;

/// A rectangle of a picture, in its pixels from the lower left corner, and how finely it is drawn.
struct Raster {
  std::uint32_t left = 0;
  std::uint32_t bottom = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t side = 1;  ///< samples along each side of a pixel, a texel of a target each
};

/// A camera with a picture size. World units, pixels.
struct View {
  glm::dvec3 eye{0.0};
  glm::dmat3 rotation{1.0};  ///< world to eye directions (x right, y up, z backward)
  glm::dmat4 projection{1.0};
  double near = 0.0;
  double slope_x = 1.0;  ///< half the picture's width and height at distance 1
  double slope_y = 1.0;
  glm::dvec2 middle{0.0};  ///< where the picture's middle is at distance 1, right and up of the
                           ///< camera's axis: 0 but for a part of a picture
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double pixels_per_sample = 0.0;  ///< levels of detail: how far apart samples may be seen
  double far_diameter = 0.0;       ///< pixels: models that are seen smaller are drawn from afar
                                   ///< (renderer/far_mesh.h); 0: none is
};

/// `near` only bounds what may be in front of the eye: with reversed floating-point depth a small
/// one costs no precision.
[[nodiscard]] View make_view(const Camera& camera, std::uint32_t width, std::uint32_t height,
                             double near);

/// What shows a part of the view's picture: its pixels are the part's samples.
[[nodiscard]] View view_of_part(const View& picture, const Raster& part);

/// The direction through a window position (pixels from the lower left corner), world, of length 1
/// along the view axis: the point at depth z is eye + z * ray_through.
[[nodiscard]] glm::dvec3 ray_through(const View& view, glm::dvec2 window);

/// The camera relative to a patch.
[[nodiscard]] shared::PatchView view_patch(const View& view, const StoredPatch& patch);

/// Whether a sphere (world) can reach into the picture.
[[nodiscard]] bool sees_sphere(const View& view, glm::dvec3 centre, double radius);

/// What all patches of a frame share. `largest_sprite` in pixels.
[[nodiscard]] shared::Frame make_frame(const View& view, double largest_sprite,
                                       const Lights& lights);

}  // namespace relief

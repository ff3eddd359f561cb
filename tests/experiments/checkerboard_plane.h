// The plane of [Zwicker 2001], Figure 8: a checkerboard, sampled at the nodes of a regular grid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/scene/camera.h"
#include "renderer/geometry/splat_cloud.h"
#include "tests/experiments/pixel_filter.h"

namespace relief::experiment {

/// A view of the plane z = 0. World unit: one spacing of the grid.
struct PlaneView {
  std::string name;
  double inclination = 0.0;  ///< degrees between the view axis and the plane's normal
  double pixels = 1.0;       ///< a spacing's width in the middle of the image
};

/// Squares of kSquare x kSquare points. The grid is turned in the plane by kTurn degrees, so that
/// it does not lie along the image's rows.
inline constexpr double kSquare = 4.0;
inline constexpr double kTurn = 10.0;

/// The plane ends this far from the place below the eye, or rather the line across the view there.
inline constexpr double kFar = 2048.0;

[[nodiscard]] Camera camera_of(const PlaneView& view, std::uint32_t side);

/// The points of the plane that an image shows, and eight spacings more; h is one spacing.
[[nodiscard]] SplatCloud plane_points(const PlaneView& view, std::uint32_t side);

/// What the image should show.
struct PlaneTruths {
  Truths checkerboard;  ///< the checkerboard itself, with its sharp edges
  /// The function that the points stand for: Eq. (1) with the normalised basis of section 5, whose
  /// Gaussians end at c = 8. Nothing sharper can come of the points.
  Truths splats;
};

/// By 32 x 32 rays a pixel.
[[nodiscard]] PlaneTruths plane_truths(const PlaneView& view, std::uint32_t side);

/// How the plane is mapped to a pixel, by the singular values of the Jacobian of section 4 in
/// pixels per spacing.
enum class Mapping : std::uint8_t {
  Magnified,    ///< both are 1 or more
  Anisotropic,  ///< one is less, as with a plane seen at grazing angles
  Minified,     ///< both are less
};

/// Of every pixel's middle; Minified where the plane is not.
[[nodiscard]] std::vector<Mapping> find_mappings(const PlaneView& view, std::uint32_t side);

}  // namespace relief::experiment

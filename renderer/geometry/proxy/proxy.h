// Models seen from afar: coarse meshes that stand for their patches where these are only a few
// pixels wide. (Drawing a patch costs as much however small it is.)
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/instance.h"
#include "common/patch.h"
#include "renderer/view/view.h"

namespace relief {

/// View::proxy_diameter where models may be drawn from afar. The Dragon, CPU time of a frame less
/// an empty one's: from afar less than as cells up to about 100 pixels, half as much again at 190.
inline constexpr double kProxyDiameter = 128.0;

/// The same of patches that meet, whose finer levels and seams cost more. The Dragon 206 pixels
/// wide: 25 ms a frame instead of 55, and 44.0 dB both; 310 pixels wide 50 ms instead of 128,
/// but 41.9 dB instead of 42.3.
inline constexpr double kProxyDiameterJoined = 256.0;

/// How far apart the vertices of a model are at most, in pixels, before a finer level is drawn; its
/// diameter may be Proxy::diameter / 2 times that. The Dragon and the Buddha 20 to 310 pixels wide,
/// lit, against a ray-traced truth of 64 rays: at 2 pixels as one ray a pixel, 0.5 to 3 dB better
/// than cells. Textures show more than two pixels do: spot, unlit, 26 dB instead of 34.
inline constexpr double kProxyPixels = 2.0;
inline constexpr double kProxyPixelsOfMaps = 1.0;  ///< of models with colours or fine normals

/// World or model frame.
struct Sphere {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// The sphere about the middle of the samples' bounds that holds all of them.
[[nodiscard]] Sphere sphere_about(std::span<const Patch> patches);

/// Spacings of the levels of a model, finest first, each the square root of 2 times the one before:
/// from what `diameter` (Proxy) asks for, but no finer than twice the model's own `spacing`. None
/// if it is too coarse for that.
[[nodiscard]] std::vector<double> proxy_spacings(const Sphere& model, double spacing,
                                                 double diameter = kProxyDiameter);

/// What is to be known of a model to draw it from afar.
struct Proxy {
  Sphere sphere;                     ///< about its samples
  double pixels = kProxyPixels;      ///< how far apart its vertices may be
  std::vector<double> spacings;      ///< of the meshes that stand for it; none: it is never far
  double diameter = kProxyDiameter;  ///< pixels: it is far if it is seen smaller
};

/// The same where a transform takes it.
[[nodiscard]] Proxy moved(const Transform& transform, const Proxy& model);

/// Whether a view draws a model from afar: one that is small enough, whose finest mesh is fine
/// enough.
[[nodiscard]] bool is_proxy(const View& view, const Proxy& model);

/// The coarsest level that the view does not show coarse.
[[nodiscard]] std::size_t choose_proxy_level(const View& view, const Proxy& model);

}  // namespace relief

// Opaque surfaces that stand among kernels: another engine draws them first, kernels are laid over
// them and end there.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/engine.h"
#include "renderer/frame/targets/film.h"

namespace relief {

/// Where surfaces end what pixels show: depths along the view axis (world units), row-major, top
/// row first. Infinite: nowhere; negative infinite: the pixel is not drawn.
struct DepthLimits {
  /// Of the part of a pixel that surfaces cover.
  std::vector<float> covered;
  /// Of the other part, where there are both: infinite in pixels that are partly covered, negative
  /// infinite in all others. Empty: no pixel is partly covered.
  std::vector<float> beside;
};

/// Limits of surfaces whose film has coverage, and the depth in the middle of each pixel. Where a
/// pixel is covered but not in its middle, the depth is the nearest of the pixels around.
[[nodiscard]] DepthLimits depth_limits(const Film& surfaces);

/// Lays kernels over surfaces: a pixel that surfaces cover by a share c shows c of the kernels
/// before them, over them, and 1 - c of the kernels without them. `covered` and `beside` are the
/// kernels as far as the limits of these names; `beside` is empty if its limits are. Depth, normal,
/// UV and patch are those of the kernels if these cover half of what is behind; otherwise those of
/// the surface. Returns the film of both.
[[nodiscard]] Film laid_over(const Film& surfaces, const Film& covered, const Film& beside);

/// Whether a model has surfaces.
[[nodiscard]] bool has_surfaces(const RenderModel& model);

/// The surfaces of a model, ready to be drawn.
class SurfacesBeside {
 public:
  /// `request`: that of an engine which draws kernels, for a model that has surfaces, too. They are
  /// drawn by the engine that its entry names.
  static Result<SurfacesBeside> prepare(const PrepareRequest& request);

  struct Drawn {
    Film film;  ///< colours premultiplied by coverage; no background
    DepthLimits limits;
    double frame_ms = 0.0;
  };
  /// Fails as the engine does.
  Result<Drawn> draw(const RenderSettings& settings, Progress& progress);

  /// As PreparedModel::probe().
  Result<Image> probe(const RenderSettings& settings, std::uint32_t x, std::uint32_t y);

 private:
  SurfacesBeside(std::string engine, std::unique_ptr<PreparedModel> prepared)
      : engine_(std::move(engine)), prepared_(std::move(prepared)) {}

  std::string engine_;
  std::unique_ptr<PreparedModel> prepared_;
};

}  // namespace relief

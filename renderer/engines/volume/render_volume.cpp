#include "renderer/engines/volume/render_volume.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume/grid_drawing.h"
#include "renderer/engines/volume/grid_rays.h"
#include "renderer/engines/volume/list_drawing.h"
#include "renderer/engines/volume/quad_drawing.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/gl/open_gl.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume {
namespace {

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, const PrepareRequest& request)
      : opengl_(request.opengl),
        environments_(request.environments),
        model_(std::move(model)),
        quads_(make_quad_drawing(gl())),
        lists_(make_list_drawing(gl())) {
    const ScalarVolume* const volume = model_.volume();
    if (volume != nullptr && std::holds_alternative<RegularGrid>(volume->placement))
      grid_ = make_grid_drawing(gl(), *volume);
  }

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    const Features features = features_of(settings, ModelMaps(false));
    RELIEF_TRY_ASSIGN(const VolumeTargets targets,
                      make_volume_targets(gl(), view.width, view.height, features));
    if (!box_ || box_version_ != model_.version()) {
      box_ = box_of(*cloud);
      box_version_ = model_.version();
    }
    std::vector<double> frame_ms;
    std::vector<double> gpu_ms;
    // The first frame, in which shaders are compiled, is not timed beside others.
    for (int i = 0; i < 1 + std::max(settings.frames, 0); ++i) {
      FrameClock clock(gl());
      RELIEF_TRY(draw(*cloud, view, settings, features, targets, clock.timer(), progress));
      const FrameTime time = clock.finish();
      if (progress.cancelled()) return interrupted_error();
      if (i == 0 && settings.frames > 0) continue;
      frame_ms.push_back(time.wall_ms);
      if (time.gpu_ms) gpu_ms.push_back(*time.gpu_ms);
    }
    RenderResult result;
    result.renderer = renderer_name(gl());
    result.frame_ms = median_of(std::move(frame_ms));
    if (!gpu_ms.empty()) result.gpu_ms = median_of(std::move(gpu_ms));
    if (gl().recorder != nullptr) result.explanation = gl().recorder->explain();
    RELIEF_TRY(check_errors(gl(), "the image"));
    RELIEF_TRY(opengl_->status());
    const Film film = read_film(gl(), targets, model_.blends_encoded(settings));
    result.image = develop(film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  [[nodiscard]] const Gl& gl() const { return opengl_->gl(); }

  /// One frame, with all that depends on the view.
  Status draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
              Features features, const VolumeTargets& targets, PassTimer& timer,
              const Progress& progress) {
    if (gl().recorder != nullptr) gl().recorder->begin_frame();
    clear_volume_targets(gl(), targets);
    VolumeFrame frame{.cloud = cloud,
                      .cloud_version = model_.version(),
                      .box = *box_,
                      .colours = {},
                      .view = view,
                      .settings = settings,
                      .is_antialiased = model_.is_antialiased(),
                      .spacing = model_.spacing(),
                      .features = features};
    const bool is_grid = is_for_grid(gl(), frame, model_.volume());
    std::vector<glm::vec3> colours;
    if (!is_grid || !grid_->lights_nodes(settings)) {
      RELIEF_TRY_ASSIGN(colours, model_.colours(cloud, settings, view, *environments_));
      frame.colours = colours;
    }
    if (is_grid) return grid_->draw(frame, targets, timer, progress);
    return (is_for_quads(frame) ? *quads_ : *lists_).draw(frame, targets, timer, progress);
  }

  std::shared_ptr<const OpenGl> opengl_;  ///< first: the last to go
  std::shared_ptr<EnvironmentCache> environments_;
  VolumeModel model_;
  std::optional<NodeBox> box_;  ///< of the kernels of this version
  std::uint64_t box_version_ = 0;
  std::unique_ptr<GridDrawing> grid_;  ///< of a regular grid
  std::unique_ptr<VolumeDrawing> quads_;
  std::unique_ptr<VolumeDrawing> lists_;
};

}  // namespace

Features features_of(const RenderSettings& settings, ModelMaps /*maps*/) {
  return (settings.outputs.normal ? RELIEF_FEATURE_OUT_NORMAL : 0U) |
         (settings.outputs.depth ? RELIEF_FEATURE_OUT_DEPTH : 0U);
}

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  assert(request.opengl != nullptr && "it is drawn with OpenGL");
  return std::unique_ptr<PreparedModel>(
      std::make_unique<Prepared>(VolumeModel(request.model), request));
}

}  // namespace relief::volume

#include "renderer/engines/volume/render_volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume/cpu/cpu_drawing.h"
#include "renderer/engines/volume/grid_drawing.h"
#include "renderer/engines/volume/grid_rays.h"
#include "renderer/engines/volume/list_drawing.h"
#include "renderer/engines/volume/quad_drawing.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/gl/open_gl.h"
#include "renderer/gl/software.h"
#include "renderer/volume/surfaces_beside.h"
#include "renderer/volume/volume_model.h"
#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, const PrepareRequest& request, std::optional<SurfacesBeside> surfaces)
      : opengl_(request.opengl),
        environments_(request.environments),
        model_(std::move(model)),
        surfaces_(std::move(surfaces)),
        quads_(make_quad_drawing(gl())),
        lists_(make_list_drawing(gl())),
        cpu_(make_cpu_drawing(gl())) {
    const ScalarVolume* const volume = model_.volume();
    if (volume != nullptr && std::holds_alternative<RegularGrid>(volume->placement))
      grid_ = make_grid_drawing(gl(), *volume);
  }

  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    const RenderSettings settings = model_.settled(asked);
    SurfacesBeside::Drawn surfaces;
    if (surfaces_) {
      RELIEF_TRY_ASSIGN(surfaces, surfaces_->draw(settings, progress));
    }
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    const Features features = features_of(settings, ModelMaps(false));
    const bool is_on_cpu = is_for_cpu(gl(), *cloud, settings.volume);
    RELIEF_TRY_ASSIGN(const auto layers, make_layers(view, surfaces.limits, features, is_on_cpu));
    if (!box_ || box_version_ != model_.version()) {
      box_ = box_of(*cloud);
      box_version_ = model_.version();
    }
    std::vector<double> frame_ms;
    std::vector<double> gpu_ms;
    // The first frame, in which shaders are compiled, is not timed beside others.
    for (int i = 0; i < 1 + std::max(settings.frames, 0); ++i) {
      FrameClock clock(gl());
      RELIEF_TRY(draw(*cloud, view, settings, features, layers, clock.timer(), progress));
      const FrameTime time = clock.finish();
      if (progress.cancelled()) return interrupted_error();
      if (i == 0 && settings.frames > 0) continue;
      frame_ms.push_back(time.wall_ms);
      if (time.gpu_ms) gpu_ms.push_back(*time.gpu_ms);
    }
    RenderResult result;
    result.renderer = renderer_name(gl());
    result.frame_ms = median_of(std::move(frame_ms)) + surfaces.frame_ms;
    if (!gpu_ms.empty()) result.gpu_ms = median_of(std::move(gpu_ms));
    if (gl().recorder != nullptr) result.explanation = gl().recorder->explain();
    if (settings.pass_frames > 0) {
      RELIEF_TRY_ASSIGN(result.passes,
                        time_passes(gl(), settings.pass_frames, progress, [&](PassTimer& timer) {
                          return draw(*cloud, view, settings, features, layers, timer, progress);
                        }));
    }
    RELIEF_TRY(check_errors(gl(), "the image"));
    RELIEF_TRY(opengl_->status());
    const bool is_encoded = model_.blends_encoded(settings);
    Film film = read_film(gl(), layers.front().targets, is_encoded);
    if (surfaces_) {
      film = laid_over(surfaces.film, film,
                       layers.size() > 1 ? read_film(gl(), layers[1].targets, is_encoded) : Film());
    }
    result.image = develop(film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

  Result<Image> probe(const RenderSettings& asked, std::uint32_t x, std::uint32_t y) override {
    const RenderSettings settings = model_.settled(asked);
    Image pixel = nothing_seen();
    if (surfaces_) {
      RELIEF_TRY_ASSIGN(pixel, surfaces_->probe(settings, x, y));
    }
    const Progress silent;
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, silent));
    const View whole = volume_view(settings);
    const View view = view_of_part(whole, {.left = x, .bottom = y, .width = 1, .height = 1});
    const std::vector<FootprintRule> footprints = model_.footprint_rules(settings, whole);
    const float limit = pixel.find("Z")->values.front();
    const float kernels =
        cpu_->depth_of_pixel({.cloud = *cloud,
                              .cloud_version = model_.version(),
                              .box = {},
                              .colours = {},
                              .colour = [](std::size_t) { return glm::vec3(0.0F); },
                              .view = view,
                              .settings = settings,
                              .footprints = footprints,
                              .features = {},
                              .limits = std::span(&limit, 1)});
    if (!std::isfinite(kernels)) return pixel;
    Image kernels_seen = nothing_seen();
    for (Channel& channel : kernels_seen.channels) {
      if (channel.name == "Z") channel.values.front() = kernels;
    }
    return kernels_seen;
  }

 private:
  [[nodiscard]] const Gl& gl() const { return opengl_->gl(); }

  /// The kernels up to some limits.
  struct Layer {
    VolumeTargets targets;
    std::span<const float> limits;
    std::optional<Texture> limits_texture;  ///< of drawings by shaders
  };

  Result<std::vector<Layer>> make_layers(const View& view, const DepthLimits& limits,
                                         Features features, bool is_on_cpu) const {
    std::vector<Layer> layers;
    for (const std::vector<float>* const depths : {&limits.covered, &limits.beside}) {
      if (depths->empty() && !layers.empty()) continue;
      RELIEF_TRY_ASSIGN(auto targets, make_volume_targets(gl(), view.width, view.height, features));
      layers.push_back({std::move(targets), *depths, {}});
      if (!depths->empty() && !is_on_cpu)
        layers.back().limits_texture = make_limits(gl(), view.width, view.height, *depths);
    }
    return layers;
  }

  /// One frame, with all that depends on the view.
  Status draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
              Features features, const std::vector<Layer>& layers, PassTimer& timer,
              const Progress& progress) {
    const std::vector<FootprintRule> footprints = model_.footprint_rules(settings, view);
    const RenderSettings lit = with_own_material(settings, settings.volume);
    if (gl().recorder != nullptr) gl().recorder->begin_frame();
    std::vector<glm::vec3> colours;
    for (const Layer& layer : layers) {
      clear_volume_targets(gl(), layer.targets);
      VolumeFrame frame{.cloud = cloud,
                        .cloud_version = model_.version(),
                        .box = *box_,
                        .colours = {},
                        .colour = {},
                        .view = view,
                        .settings = lit,
                        .footprints = footprints,
                        .spacing = model_.spacing(),
                        .features = features,
                        .limits = layer.limits};
      if (is_for_cpu(gl(), cloud, settings.volume)) {
        RELIEF_TRY_ASSIGN(frame.colour, model_.colour_of(cloud, settings, view, *environments_));
        RELIEF_TRY_ASSIGN(const auto lights, model_.distant_lights(settings, view, *environments_));
        frame.distant_lights = lights ? &*lights : nullptr;
        RELIEF_TRY(cpu_->draw(frame, layer.targets, timer, progress));
        continue;
      }
      const bool is_grid = is_for_grid(gl(), frame, model_.volume());
      if (colours.empty() && !(is_grid && grid_->lights_nodes(lit))) {
        RELIEF_TRY_ASSIGN(colours, model_.colours(cloud, settings, view, *environments_));
      }
      frame.colours = colours;
      const GLuint limits = layer.limits_texture ? layer.limits_texture->id() : 0;
      gl().BindTextureUnit(RELIEF_VOLUME_TEXTURE_LIMITS, limits);
      VolumeDrawing& drawing = is_grid ? *grid_ : is_for_quads(frame) ? *quads_ : *lists_;
      RELIEF_TRY(drawing.draw(frame, layer.targets, timer, progress));
      gl().BindTextureUnit(RELIEF_VOLUME_TEXTURE_LIMITS, 0);
    }
    return {};
  }

  std::shared_ptr<const OpenGl> opengl_;  ///< first: the last to go
  std::shared_ptr<EnvironmentCache> environments_;
  VolumeModel model_;
  std::optional<SurfacesBeside> surfaces_;
  std::optional<NodeBox> box_;  ///< of the kernels of this version
  std::uint64_t box_version_ = 0;
  std::unique_ptr<GridDrawing> grid_;  ///< of a regular grid
  std::unique_ptr<VolumeDrawing> quads_;
  std::unique_ptr<VolumeDrawing> lists_;
  std::unique_ptr<CpuDrawing> cpu_;
};

}  // namespace

Features features_of(const RenderSettings& settings, ModelMaps /*maps*/) {
  return (settings.outputs.normal ? RELIEF_FEATURE_OUT_NORMAL : 0U) |
         (settings.outputs.depth ? RELIEF_FEATURE_OUT_DEPTH : 0U);
}

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  assert(request.opengl != nullptr && "it is drawn with OpenGL");
  std::optional<SurfacesBeside> surfaces;
  if (has_surfaces(request.model)) {
    RELIEF_TRY_ASSIGN(surfaces, SurfacesBeside::prepare(request));
  }
  return std::unique_ptr<PreparedModel>(
      std::make_unique<Prepared>(VolumeModel(request.model), request, std::move(surfaces)));
}

}  // namespace relief::volume

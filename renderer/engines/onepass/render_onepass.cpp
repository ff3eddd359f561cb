#include "renderer/engines/onepass/render_onepass.h"

#include <utility>

#include "renderer/engine_cache.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/gl_model.h"
#include "renderer/gl_picture.h"

namespace relief::onepass {
namespace {

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public PreparedModel {
 public:
  explicit Prepared(std::unique_ptr<GlModel> model) : model_(std::move(model)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& /*progress*/) override {
    const std::uint32_t features = features_of(settings, model_->has_colours());
    const auto engine = engines_.get(*model_, features);
    if (!engine) return engine.error();
    const auto counting = engines_.get(*model_, features | RELIEF_FEATURE_COUNT_FRAGMENTS);
    if (!counting) return counting.error();
    const auto picture = model_->make_picture(settings);
    if (!picture) return picture.error();
    const auto draw_with = [](const Engine& drawing) {
      return [&drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame.view, timer, frame.environment);
      };
    };
    return model_->draw(*picture, draw_with(**engine), draw_with(**counting), settings);
  }

 private:
  std::unique_ptr<GlModel> model_;  ///< first: the last to go
  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PatchModel& model,
                                               std::span<const RenderSettings> views) {
  auto on_gpu = GlModel::create(model, views, needs_of(views, model.has_colours, features_of));
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(std::move(*on_gpu)));
}

}  // namespace relief::onepass

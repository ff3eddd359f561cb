#include "renderer/engines/onepass/render_onepass.h"

#include <map>
#include <utility>

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
    const auto engine = engine_for(features);
    if (!engine) return engine.error();
    const auto counting = engine_for(features | RELIEF_FEATURE_COUNT_FRAGMENTS);
    if (!counting) return counting.error();
    const auto picture = model_->make_picture(settings);
    if (!picture) return picture.error();
    const auto draw_with = [](const Engine& drawing) {
      return [&drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame.view, timer, frame.environment);
      };
    };
    auto result = draw_picture(model_->gl(), *picture, draw_with(**engine), draw_with(**counting),
                               settings);
    const Status quiet = model_->debug_status();
    if (result && !quiet) return quiet.error();
    return result;
  }

 private:
  Result<const Engine*> engine_for(std::uint32_t features) {
    auto found = engines_.find(features);
    if (found == engines_.end()) {
      Result<Engine> made = Engine::create(model_->gl(), model_->store(), features);
      if (!made) return made.error();
      found = engines_.emplace(features, std::move(*made)).first;
    }
    return &found->second;
  }

  std::unique_ptr<GlModel> model_;           ///< first: the last to go
  std::map<std::uint32_t, Engine> engines_;  ///< by feature bits
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PatchModel& model,
                                               std::span<const RenderSettings> views) {
  StoreNeeds needs;
  for (const RenderSettings& settings : views) {
    const StoreNeeds more = needs_of(features_of(settings, model.has_colours));
    needs.normals = needs.normals || more.normals;
    needs.colours = needs.colours || more.colours;
  }
  auto on_gpu = GlModel::create(model, views, needs);
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(std::move(*on_gpu)));
}

}  // namespace relief::onepass

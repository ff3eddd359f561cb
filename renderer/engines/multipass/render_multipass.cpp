#include "renderer/engines/multipass/render_multipass.h"

#include <utility>
#include <vector>

#include "renderer/engine_cache.h"
#include "renderer/engines/multipass/multipass.h"
#include "renderer/engines/multipass/sums.h"
#include "renderer/features.h"
#include "renderer/gl_model.h"
#include "renderer/gl_picture.h"
#include "renderer/materials.h"

namespace relief::multipass {
namespace {

/// Of several materials each pixel has that of the patch in front, so that it must be known.
RenderSettings with_patch_ids(RenderSettings settings) {
  settings.outputs.patch_id |= materials_of(settings).size() > 1;
  return settings;
}

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public PreparedModel {
 public:
  explicit Prepared(std::unique_ptr<GlModel> model) : model_(std::move(model)) {}

  Result<RenderResult> render(const RenderSettings& asked, Progress& /*progress*/) override {
    const RenderSettings settings = with_patch_ids(asked);
    const std::uint32_t features = scene_features(settings, model_->has_colours());
    const auto engine = engines_.get(*model_, features);
    if (!engine) return engine.error();
    const auto counting = engines_.get(*model_, features | RELIEF_FEATURE_COUNT_FRAGMENTS);
    if (!counting) return counting.error();
    const auto picture = model_->make_picture(settings);
    if (!picture) return picture.error();
    const auto sums = make_sums(model_->gl(), picture->targets, features);
    if (!sums) return sums.error();
    const double factor = settings.multipass.radius_factor;
    const auto draw_with = [&sums, factor](const Engine& drawing) {
      return [&sums, factor, &drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame, *sums, factor, timer);
      };
    };
    auto result = model_->draw(*picture, draw_with(**engine), draw_with(**counting), settings);
    if (result && !asked.outputs.patch_id) {
      std::erase_if(result->image.channels,
                    [](const Channel& channel) { return channel.name == "patch"; });
    }
    return result;
  }

 private:
  std::unique_ptr<GlModel> model_;  ///< first: the last to go
  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PatchModel& model,
                                               std::span<const RenderSettings> views) {
  auto on_gpu = GlModel::create(model, views, needs_of(views, model.has_colours, scene_features));
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(std::move(*on_gpu)));
}

}  // namespace relief::multipass

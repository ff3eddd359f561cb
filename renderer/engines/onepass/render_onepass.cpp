#include "renderer/engines/onepass/render_onepass.h"

#include <utility>

#include "renderer/engine_cache.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/gl_picture.h"

namespace relief::onepass {
namespace {

/// The model on the GPU, and the programs that pictures have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  Result<GlDrawing> make_drawing(const RenderSettings& settings) override {
    const std::uint32_t features = features_of(settings, model().colours());
    auto picture = model().make_picture(settings);
    if (!picture) return picture.error();
    const auto draw_with = [](const Engine& drawing) {
      return [&drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame.view, timer, frame.environment);
      };
    };
    return engines_.make_drawing(model(), features, std::move(*picture), !settings.explain,
                                 draw_with);
  }

 private:
  EngineCache<Engine> engines_;
};

}  // namespace

Result<std::unique_ptr<GlPreparedModel>> prepare(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views) {
  return prepare_on_gpu<Prepared>(std::move(opengl), model, views, features_of);
}

}  // namespace relief::onepass

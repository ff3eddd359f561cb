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

  Result<GlDrawing> make_drawing(const RenderSettings& settings, const Raster& part) override {
    std::uint32_t features = features_of(settings, model().colours());
    if (!can_be_found(model().store())) features &= ~RELIEF_FEATURE_VISIBILITY;
    auto picture = model().make_picture(settings, part);
    if (!picture) return picture.error();
    std::shared_ptr<const Visibility> visibility;
    if ((features & RELIEF_FEATURE_VISIBILITY) != 0) {
      auto made = make_visibility(model().gl(), picture->targets, features);
      if (!made) return made.error();
      visibility = std::make_shared<const Visibility>(std::move(*made));
    }
    const auto draw_with = [&visibility](const Engine& drawing) {
      return [visibility, &drawing](const GlPicture& frame, PassTimer& timer) {
        drawing.draw(frame, visibility.get(), timer);
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

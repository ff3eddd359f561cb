// What an engine on OpenGL implements.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "common/error.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_image.h"
#include "renderer/frame/gl_model.h"
#include "renderer/frame/supersample.h"
#include "renderer/prepared.h"

namespace relief {

/// A model on the GPU that an engine there has made ready.
class GlPreparedModel : public PreparedModel {
 public:
  explicit GlPreparedModel(std::unique_ptr<GlModel> model) : model_(std::move(model)) {}

  /// A part of a picture ready to be drawn, for any number of frames. It must go before this does.
  virtual Result<GlDrawing> make_drawing(const RenderSettings& settings, const Raster& part) = 0;

  /// The whole picture, one sample a pixel.
  Result<GlDrawing> make_drawing(const RenderSettings& settings) {
    return make_drawing(settings, {0, 0, settings.width, settings.height, 1});
  }

  Result<RenderResult> render(const RenderSettings& settings, Progress& /*progress*/) override {
    return settings.samples > 1 ? render_supersampled(*this, settings) : render_once(settings);
  }

  /// With one sample a pixel, whatever the settings say.
  Result<RenderResult> render_once(const RenderSettings& settings) {
    const auto drawing = make_drawing(settings);
    if (!drawing) return drawing.error();
    auto result = model_->draw(*drawing, settings);
    if (result)
      read_picture(model_->gl(), drawing->picture, settings.background.has_value(), *result);
    return result;
  }

  [[nodiscard]] GlModel& model() const { return *model_; }

 private:
  std::unique_ptr<GlModel> model_;  ///< first: what derived classes make of it goes before
};

/// Makes a model ready for an engine, whose feature bits of a picture features_of(settings,
/// colours) gives.
template <class Prepared, class FeaturesOf>
Result<std::unique_ptr<GlPreparedModel>> prepare_on_gpu(std::shared_ptr<const OpenGl> opengl,
                                                        const PatchModel& model,
                                                        std::span<const RenderSettings> views,
                                                        const FeaturesOf& features_of) {
  auto on_gpu = GlModel::create(std::move(opengl), model, views,
                                needs_of(views, ModelMaps(model), features_of));
  if (!on_gpu) return on_gpu.error();
  return std::unique_ptr<GlPreparedModel>(std::make_unique<Prepared>(std::move(*on_gpu)));
}

}  // namespace relief

// What an engine on OpenGL implements.
#pragma once

#include <cassert>
#include <memory>
#include <span>
#include <utility>

#include "common/error.h"
#include "renderer/engine.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_image.h"
#include "renderer/frame/gl_model.h"
#include "renderer/frame/supersample.h"

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
    RELIEF_TRY_ASSIGN(const auto drawing, make_drawing(settings));
    auto result = model_->draw(drawing, settings);
    if (result)
      read_picture(model_->gl(), drawing.picture, settings.background.has_value(), *result);
    return result;
  }

  [[nodiscard]] GlModel& model() const { return *model_; }

 private:
  std::unique_ptr<GlModel> model_;  ///< first: what derived classes make of it goes before
};

/// Makes a model ready for an engine, whose feature bits of an image features_of(settings, maps)
/// gives.
template <class Prepared, class FeaturesOf>
Result<std::unique_ptr<PreparedModel>> prepare_on_gpu(const PrepareRequest& request,
                                                      const FeaturesOf& features_of) {
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && request.opengl != nullptr && "patches, to be drawn with OpenGL");
  RELIEF_TRY_ASSIGN(auto on_gpu,
                    GlModel::create(request.opengl, *patches, request.views,
                                    needs_of(request.views, ModelMaps(*patches), features_of)));
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(std::move(on_gpu)));
}

}  // namespace relief

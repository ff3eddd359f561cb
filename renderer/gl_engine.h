// What an engine on OpenGL implements.
#pragma once

#include <memory>
#include <utility>

#include "common/error.h"
#include "renderer/gl_model.h"
#include "renderer/gl_picture.h"
#include "renderer/prepared.h"

namespace relief {

/// A model on the GPU that an engine there has made ready.
class GlPreparedModel : public PreparedModel {
 public:
  explicit GlPreparedModel(std::unique_ptr<GlModel> model) : model_(std::move(model)) {}

  /// A picture ready to be drawn, for any number of frames. It must go before this does.
  virtual Result<GlDrawing> make_drawing(const RenderSettings& settings) = 0;

  Result<RenderResult> render(const RenderSettings& settings, Progress& /*progress*/) override {
    const auto drawing = make_drawing(settings);
    if (!drawing) return drawing.error();
    return model_->draw(*drawing, settings);
  }

 protected:
  [[nodiscard]] GlModel& model() const { return *model_; }

 private:
  std::unique_ptr<GlModel> model_;  ///< first: what derived classes make of it goes before
};

}  // namespace relief

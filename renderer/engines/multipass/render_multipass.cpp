#include "renderer/engines/multipass/render_multipass.h"

#include <memory>
#include <utility>
#include <vector>

#include "renderer/engines/multipass/drawing.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/variant_cache.h"
#include "renderer/shading/materials.h"

namespace relief::multipass {
namespace {

/// It splats samples, always the finest; and of several materials each pixel has that of the patch
/// in front, so that the patch must be known.
RenderSettings splatted(RenderSettings settings) {
  if (settings.primitive == Primitive::Cell) settings.primitive = Primitive::Quad;
  settings.pixels_per_sample = 0.0;
  settings.outputs.patch_id |= materials_of(settings).size() > 1;
  return settings;
}

/// The model on the GPU, and the variants that images have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  [[nodiscard]] RenderSettings settled(const RenderSettings& asked) const override {
    return splatted(asked);
  }

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                  const RenderSettings& settings,
                                                  Counting counting) override {
    Features features = scene_features(settings, model().maps());
    RELIEF_TRY_ASSIGN(auto sums, make_sums(model().gl(), frame.targets, features));
    if (counting == Counting::On) features |= RELIEF_FEATURE_COUNT_FRAGMENTS;
    RELIEF_TRY_ASSIGN(const Variant* variant, variants_.get(model(), features));
    return std::unique_ptr<GlDrawing>(
        std::make_unique<Drawing>(*variant, std::move(sums), settings.multipass.radius_factor));
  }

 private:
  VariantCache<Variant> variants_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  std::vector<RenderSettings> views;
  views.reserve(request.views.size());
  for (const RenderSettings& settings : request.views) views.push_back(splatted(settings));
  PrepareRequest settled = request;
  settled.views = views;
  return prepare_on_gpu<Prepared>(settled, scene_features);
}

}  // namespace relief::multipass

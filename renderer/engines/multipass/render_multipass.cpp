#include "renderer/engines/multipass/render_multipass.h"

#include <memory>
#include <utility>
#include <vector>

#include "renderer/engines/multipass/clip_tables.h"
#include "renderer/engines/multipass/drawing.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/variant_cache.h"
#include "renderer/shading/materials.h"
#include "renderer/view/sided_list.h"

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

/// Those of the image, and what clips splats.
Features splat_features(const RenderSettings& settings, ModelMaps maps) {
  const Features features = scene_features(settings, maps);
  if (settings.clip.rule == ClipRule::Off) return features;
  return features | RELIEF_FEATURE_CLIPPED |
         (settings.clip.rule == ClipRule::Wicke ? RELIEF_FEATURE_CLIP_WICKE : 0U) |
         (settings.outputs.clip ? RELIEF_FEATURE_OUT_CLIP : 0U);
}

/// The model on the GPU, and the variants that images have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  /// `patches`: what the model on the GPU is made of; null if they come and go.
  void set_patches(const PatchModel* patches) { clips_.set_model(patches); }

  /// What clips the splats is found first, with progress.
  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    RELIEF_TRY(clip_tables(asked, progress));
    return GlPreparedModel::render(asked, progress);
  }

  [[nodiscard]] RenderSettings settled(const RenderSettings& asked) const override {
    return splatted(asked);
  }

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                  const RenderSettings& settings,
                                                  Counting counting) override {
    Progress silent;
    RELIEF_TRY_ASSIGN(const ClipTables* const clip, clip_tables(settings, silent));
    Features features = splat_features(settings, model().maps());
    if (shows_backs(model().store(), frame.view)) features |= RELIEF_FEATURE_SIDED;
    RELIEF_TRY_ASSIGN(auto sums, make_sums(model().gl(), frame.targets, features));
    if (counting == Counting::On) features |= RELIEF_FEATURE_COUNT_FRAGMENTS;
    RELIEF_TRY_ASSIGN(const Variant* variant, variants_.get(model(), features));
    return std::unique_ptr<GlDrawing>(std::make_unique<Drawing>(
        *variant, std::move(sums), settings.multipass.radius_factor, clip));
  }

 private:
  Result<const ClipTables*> clip_tables(const RenderSettings& settings, Progress& progress) {
    return clips_.get(model().gl(), model().store(), settings.clip,
                      settings.multipass.radius_factor, progress);
  }

  ClipTableCache clips_;
  VariantCache<Variant> variants_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  std::vector<RenderSettings> views;
  views.reserve(request.views.size());
  for (const RenderSettings& settings : request.views) views.push_back(splatted(settings));
  PrepareRequest settled = request;
  settled.views = views;
  RELIEF_TRY_ASSIGN(auto prepared, prepare_on_gpu<Prepared>(settled, scene_features));
  const bool comes_and_goes = request.pool != nullptr;
  static_cast<Prepared&>(*prepared).set_patches(comes_and_goes ? nullptr
                                                               : request.model.find<PatchModel>());
  return prepared;
}

}  // namespace relief::multipass

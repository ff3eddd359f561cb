#include "renderer/engines/onepass/render_onepass.h"

#include <memory>
#include <utility>
#include <vector>

#include "renderer/engines/onepass/drawing.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/layered_drawing.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/frame/variant_cache.h"
#include "renderer/shading/materials.h"

namespace relief::onepass {
namespace {

/// The patches whose materials are opaque, or those whose are not.
MaterialChoice materials_that_are(const RenderSettings& settings, bool opaque) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  MaterialChoice choice;
  for (std::size_t i = 0; i < kMaxMaterials; ++i) {
    const MaterialSettings& material = all[i < all.size() ? i : 0];  // one: that of all patches
    choice.drawn.push_back(is_transparent(material) != opaque);
  }
  return choice;
}

/// The materials of bodies that light leaves through a second interface.
MaterialChoice materials_of_bodies(const RenderSettings& settings) {
  const std::vector<MaterialSettings> all = materials_of(settings);
  MaterialChoice choice;
  for (std::size_t i = 0; i < kMaxMaterials; ++i)
    choice.drawn.push_back(has_two_interfaces(all[i < all.size() ? i : 0]));
  return choice;
}

/// The model on the GPU, and the variants that images have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  using GlPreparedModel::GlPreparedModel;

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                  const RenderSettings& settings,
                                                  Counting counting) override {
    RELIEF_TRY_ASSIGN(Features features, features_for(settings));
    if (is_transparent(settings)) {
      if (counting == Counting::On) return std::unique_ptr<GlDrawing>();
      return make_layered(frame, settings, features);
    }
    if (counting == Counting::On) features |= RELIEF_FEATURE_COUNT_FRAGMENTS;
    RELIEF_TRY_ASSIGN(const Variant* variant, variants_.get(model(), features));
    RELIEF_TRY_ASSIGN(auto buffers, make_buffers(frame, settings, features));
    return std::unique_ptr<GlDrawing>(
        std::make_unique<Drawing>(*variant, std::move(buffers), MaterialChoice{}));
  }

 private:
  /// The features of an image, but for what the model is too large for.
  [[nodiscard]] Result<Features> features_for(const RenderSettings& settings) const {
    const Features features = features_of(settings, model().maps());
    if (can_be_found(model().store())) return features;
    if (has_two_interfaces(settings))
      return make_error("a scene of more than a million patches can't have two interfaces");
    if (is_transparent(settings))
      return make_error("a scene of more than a million patches can't be semi-transparent");
    return features.without(RELIEF_FEATURE_VISIBILITY);
  }

  [[nodiscard]] Result<Buffers> make_buffers(const GlFrame& frame, const RenderSettings& settings,
                                             Features features) const {
    Buffers buffers;
    if (!features.has(RELIEF_FEATURE_VISIBILITY)) return buffers;
    const Targets& targets = frame.targets;
    RELIEF_TRY_ASSIGN(
        buffers.visibility,
        make_visibility(model().gl(), {targets.width, targets.height}, targets.z_buffer, features));
    if (!features.has(RELIEF_FEATURE_TWO_INTERFACES)) return buffers;
    RELIEF_TRY_ASSIGN(buffers.back, make_back(model().gl(), model().view_of(settings),
                                              materials_of_bodies(settings), features));
    return buffers;
  }

  Result<std::unique_ptr<GlDrawing>> make_layered(const GlFrame& frame,
                                                  const RenderSettings& settings,
                                                  Features features) {
    RELIEF_TRY_ASSIGN(const Variant* opaque, variants_.get(model(), features));
    RELIEF_TRY_ASSIGN(const Variant* layered,
                      variants_.get(model(), features | RELIEF_FEATURE_LAYERED));
    RELIEF_TRY_ASSIGN(auto layers, make_layers(model().gl(), frame.targets, features));
    RELIEF_TRY_ASSIGN(auto buffers, make_buffers(frame, settings, features));
    return std::unique_ptr<GlDrawing>(std::make_unique<LayeredDrawing>(
        LayeredDrawing::Parts{.opaque = *opaque,
                              .layered = *layered,
                              .buffers = std::move(buffers),
                              .layers = std::move(layers),
                              .opaque_materials = materials_that_are(settings, true),
                              .transparent_materials = materials_that_are(settings, false)}));
  }

  VariantCache<Variant> variants_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  return prepare_on_gpu<Prepared>(request, features_of);
}

}  // namespace relief::onepass

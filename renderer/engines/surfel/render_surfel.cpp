#include "renderer/engines/surfel/render_surfel.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "common/is_finite.h"
#include "common/transform.h"
#include "renderer/clip/refitted_cloud.h"
#include "renderer/engines/surfel/drawing.h"
#include "renderer/engines/surfel/programs.h"
#include "renderer/engines/surfel/shapes.h"
#include "renderer/engines/surfel/surfel_clip.h"
#include "renderer/engines/surfel/surfel_tables.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/geometry/splats_of_samples.h"
#include "renderer/owned_or_borrowed.h"
#include "renderer/shading/materials.h"
#include "renderer/view/cull_mode.h"

namespace relief::surfel {
namespace {

/// What surfels depend on.
struct StoreKey {
  SurfelSize size;
  std::optional<double> scale;
  bool clipped;
  bool refitted;  ///< the normals

  bool operator<(const StoreKey& other) const {
    return std::tie(size, scale, clipped, refitted) <
           std::tie(other.size, other.scale, other.clipped, other.refitted);
  }
};

/// Surfels, the shapes that they are drawn with, and the programs that images have needed so far.
class Prepared final : public GlPreparedModel {
 public:
  template <class Cloud>
  Prepared(std::unique_ptr<GlModel> model, Cloud&& cloud, bool closed)
      : GlPreparedModel(std::move(model)),
        cloud_(std::forward<Cloud>(cloud)),
        drawn_(*cloud_),
        closed_(closed),
        nothing_(this->model().gl(), "no attributes") {}

  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const SurfelStore* const store, store_for(asked, progress));
    RELIEF_TRY(clip_for(*store, asked, progress));
    return GlPreparedModel::render(asked, progress);
  }

  /// There is no primitive to choose.
  [[nodiscard]] RenderSettings settled(const RenderSettings& asked) const override {
    RenderSettings settings = asked;
    settings.primitive = Primitive::Cell;
    // Mean surfels have no texture coordinates: those of a node may be on several charts.
    if (is_textured()) settings.pixels_per_sample = 0.0;
    return settings;
  }

  Result<std::unique_ptr<GlDrawing>> make_drawing(const GlFrame& frame,
                                                  const RenderSettings& settings,
                                                  Counting counting) override {
    Progress silent;  // render() has made them with the user's
    RELIEF_TRY_ASSIGN(const SurfelStore* const store, store_for(settings, silent));
    RELIEF_TRY_ASSIGN(const SurfelClip* const clip, clip_for(*store, settings, silent));
    Features features = drawn_features(settings);
    if (!hides_backs(*store, frame.view, settings)) features |= RELIEF_FEATURE_SIDED;
    RELIEF_TRY_ASSIGN(auto sums, make_sums(model().gl(), frame.targets, summed_features(features),
                                           SumPrecision::Full, true));
    if (counting == Counting::On) features |= RELIEF_FEATURE_COUNT_FRAGMENTS;
    if (const char* const contradiction = contradiction_in(features))
      return make_error("{}; this is a mistake in Relief", contradiction);
    Programs& programs = programs_.try_emplace(features, model().gl(), features).first->second;
    RELIEF_TRY_ASSIGN(const Program* const shading, programs.shading());
    DrawingParts parts{.gl = model().gl(),
                       .store = *store,
                       .ways = {},
                       .clip = clip,
                       .shading = *shading,
                       .nothing = nothing_,
                       .settings = settings};
    for (const SurfelKind& kind : kSurfelKinds) {
      if (kind.curved && settings.surfel.curved == SurfelCurved::None) continue;
      if (kind.clipped && clip == nullptr) continue;
      RELIEF_TRY_ASSIGN(auto* of_kind, programs.of(kind));
      const Shape& shape = kind.curved ? curved_shape() : polygon(settings.surfel.sides);
      parts.ways[kind.index()] = {&shape, of_kind};
    }
    return std::unique_ptr<GlDrawing>(std::make_unique<Drawing>(std::move(parts), std::move(sums)));
  }

 private:
  /// Those of the image, and of what the cloud has.
  [[nodiscard]] Features drawn_features(const RenderSettings& settings) const {
    ModelMaps maps(!(*cloud_).colours.empty() || is_textured());
    maps.fine_colours = is_textured();
    Features features = scene_features(settings, maps);
    if (settings.surfel.blend == SurfelBlend::Sorted) features |= RELIEF_FEATURE_SORTED;
    if (settings.clip.rule == ClipRule::Off) return features;
    features |= RELIEF_FEATURE_CLIPPED;
    if (settings.clip.rule == ClipRule::Wicke) features |= RELIEF_FEATURE_CLIP_WICKE;
    if (settings.outputs.clip) features |= RELIEF_FEATURE_OUT_CLIP;
    return features;
  }

  [[nodiscard]] bool is_textured() const {
    return (*cloud_).texture != nullptr && !(*cloud_).texcoords.empty();
  }

  /// What clips the surfels: that of the last settings is kept. Null: nothing does.
  Result<const SurfelClip*> clip_for(const SurfelStore& store, const RenderSettings& settings,
                                     Progress& progress) {
    if (settings.clip.rule == ClipRule::Off) return nullptr;
    if (!clip_ || clip_of_ != &store || clip_settings_ != settings.clip) {
      RELIEF_TRY_ASSIGN(
          clip_, make_surfel_clip(model().gl(), store.set, classified_as(settings.clip), progress));
      clip_of_ = &store;
      clip_settings_ = settings.clip;
    }
    return &*clip_;
  }

  Result<const SurfelStore*> store_for(const RenderSettings& settings, Progress& progress) {
    const StoreKey key{settings.surfel.size, settings.surfel.scale,
                       settings.clip.rule != ClipRule::Off, refits_normals(settings.clip)};
    auto found = stores_.find(key);
    if (found == stores_.end()) {
      const Gl& gl = model().gl();
      RELIEF_TRY_ASSIGN(const SplatCloud* const cloud, drawn_.get(settings.clip, progress));
      RELIEF_TRY_ASSIGN(SurfelSet set,
                        make_surfel_set(*cloud, settings.surfel, key.clipped, progress));
      RELIEF_TRY_ASSIGN(SurfelTables tables, upload_surfels(gl, set, *cloud));
      const std::vector<shared::DrawnSurfel> empty(set.points.size());
      Table drawn = make_table(gl, "drawn surfels", GL_RGBA32UI,
                               std::span<const shared::DrawnSurfel>(empty), GL_DYNAMIC_STORAGE_BIT);
      RELIEF_TRY(check_errors(gl, "the surfels"));
      found = stores_
                  .emplace(key, SurfelStore{std::move(set), std::move(tables), std::move(drawn),
                                            closed_})
                  .first;
    }
    return &found->second;
  }

  const Shape& polygon(int sides) {
    auto found = polygons_.find(sides);
    if (found == polygons_.end())
      found = polygons_.emplace(sides, Shape(model().gl(), polygon_outline(sides))).first;
    return found->second;
  }

  const Shape& curved_shape() {
    if (!curved_shape_) curved_shape_.emplace(model().gl(), curved_outline());
    return *curved_shape_;
  }

  OwnedOrBorrowed<SplatCloud> cloud_;
  RefittedCloud drawn_;
  bool closed_;
  VertexArray nothing_;
  std::map<StoreKey, SurfelStore> stores_;
  std::optional<SurfelClip> clip_;
  const SurfelStore* clip_of_ = nullptr;
  ClipSettings clip_settings_;
  std::map<int, Shape> polygons_;
  std::optional<Shape> curved_shape_;
  std::map<Features, Programs> programs_;
};

/// How far discs reach at most, over the cloud's own radii, of usual settings. Depths of an
/// orthographic camera have more room than that.
constexpr double kReachRadii = 2.0;

/// The near plane of a view (renderer/frame/gl_model.cpp) is a hundredth of this part of the
/// smallest radius away: nothing is cut off that is about the eye. With reversed depth values in
/// floats that costs no precision.
constexpr double kNearRadii = 1e-8;

/// Depth values of smaller distances vanish.
constexpr double kLeastSpacing = 1e-24;

/// What a view's depths need to know of the points, as the patches of no samples.
PatchModel extent_of(const SplatCloud& cloud) {
  PatchModel extent;
  double smallest = kLargestRadius;
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    const glm::dvec3 position = cloud.positions[k];
    const double radius = cloud.radii[k];
    if (!is_finite(position) || !(radius > 0.0 && radius <= kLargestRadius)) continue;
    extend(extent.bounds, position - kReachRadii * radius);
    extend(extent.bounds, position + kReachRadii * radius);
    smallest = std::min(smallest, radius);
  }
  extent.spacing = std::max(kNearRadii * smallest, kLeastSpacing);
  return extent;
}

/// Whether the points are known to be of a closed surface.
bool is_closed(const RenderModel& model) {
  const auto* const patches = model.find<PatchModel>();
  return patches != nullptr && has_closed_bodies(*patches);
}

}  // namespace

Features features_of(const RenderSettings& settings, ModelMaps maps) {
  return scene_features(settings, maps);
}

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  assert(request.opengl != nullptr && "it is drawn with OpenGL");
  const auto make = [&](auto&& cloud) -> Result<std::unique_ptr<PreparedModel>> {
    const PatchModel extent = extent_of(cloud);
    RELIEF_TRY_ASSIGN(auto on_gpu, GlModel::create({.opengl = request.opengl,
                                                    .environments = request.environments,
                                                    .patches = extent}));
    return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(
        std::move(on_gpu), std::forward<decltype(cloud)>(cloud), is_closed(request.model)));
  };
  if (const auto* const cloud = request.model.find<SplatCloud>()) return make(*cloud);
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && "there are points, or patches");
  return make(patches->instances.empty() ? splats_of_samples(*patches)
                                         : splats_of_samples(bake(*patches)));
}

}  // namespace relief::surfel

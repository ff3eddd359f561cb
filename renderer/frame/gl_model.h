// A model and its surroundings on OpenGL, for any engine there and any number of images.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/engine.h"
#include "renderer/frame/features.h"
#include "renderer/frame/gl_frame.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/open_gl.h"
#include "renderer/settings.h"
#include "renderer/shading/environment/environment.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/store/collected_store.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/pool/patch_pool.h"

namespace relief {

/// What a model on the GPU is made of.
struct GlModelParts {
  std::shared_ptr<const OpenGl> opengl;
  std::shared_ptr<EnvironmentCache> environments;
  const PatchModel& patches;
  std::span<const RenderSettings> views = {};  ///< settled
  KeptLevels levels = KeptLevels::OfViews;
  const PatchPool* pool = nullptr;      ///< as PrepareRequest has it
  CollectedStore* collected = nullptr;  ///< likewise
  StoreNeeds needs = {};                ///< of all views
};

/// The model's patches, and the environments that images have needed so far. What is made of it
/// must go before it does.
class GlModel {
 public:
  /// Uploads what is needed of the levels that the views choose, or of all.
  static Result<std::unique_ptr<GlModel>> create(GlModelParts parts);

  [[nodiscard]] const Gl& gl() const { return opengl_->gl(); }
  [[nodiscard]] const PatchStore& store() const { return pool_ ? pool_->store() : *store_; }
  [[nodiscard]] ModelMaps maps() const { return maps_; }

  /// Makes what a part of an image needs whatever engine draws it. Fails if the part is larger than
  /// OpenGL allows or an environment can't be read. `targets`: of the part's size and the outputs,
  /// if there are any to be used again.
  Result<GlFrame> make_frame(const RenderSettings& settings, const Raster& part,
                             std::optional<Targets> targets = {});

  /// What is uploaded for some views.
  [[nodiscard]] static StoreOrder order_for(const PatchModel& model,
                                            std::span<const RenderSettings> views,
                                            const StoreNeeds& needs, KeptLevels levels);

  /// The view of a whole image, one sample a pixel.
  [[nodiscard]] View view_of(const RenderSettings& settings) const;

  /// Fails if OpenGL has complained in a debug context.
  [[nodiscard]] Status status() const { return opengl_->status(); }

  /// What averages the samples of pixels; made when it is first asked for.
  Result<const Resolve*> resolve();

 private:
  GlModel() = default;
  Result<const Texture*> environment_for(const std::filesystem::path& path, float roughness);
  Result<const Texture*> rough_environments_for(const std::filesystem::path& path,
                                                const std::vector<float>& roughnesses);
  Status add_materials(const RenderSettings& settings, GlFrame& frame);
  Result<const Backdrop*> backdrop(const RenderSettings& settings);

  std::shared_ptr<const OpenGl> opengl_;  ///< first: the last to go
  std::shared_ptr<EnvironmentCache> cubes_;
  const PatchPool* pool_ = nullptr;
  std::optional<PatchStore> store_;                                          ///< without a pool
  std::map<std::pair<std::filesystem::path, float>, Texture> environments_;  ///< by roughness
  std::map<std::pair<std::filesystem::path, std::vector<float>>, Texture> rough_environments_;
  std::map<bool, Backdrop> backdrops_;  ///< by whether the camera is orthographic
  std::optional<Resolve> resolve_;
  ModelMaps maps_{false};
  DepthNeeds depth_needs_;
};

}  // namespace relief

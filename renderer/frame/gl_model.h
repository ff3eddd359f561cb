// A model and its surroundings on OpenGL, for any engine there and any number of pictures.
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
#include "renderer/frame/features.h"
#include "renderer/frame/gl_image.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/open_gl.h"
#include "renderer/result.h"
#include "renderer/settings.h"
#include "renderer/shading/environment.h"
#include "renderer/store/patch_store.h"

namespace relief {

/// The model's patches, and the environments that pictures have needed so far. What is made of it
/// must go before it does.
class GlModel {
 public:
  /// Uploads of the model the levels that the views choose, and what is needed of them.
  static Result<std::unique_ptr<GlModel>> create(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views,
                                                 const StoreNeeds& needs);

  [[nodiscard]] const Gl& gl() const { return opengl_->gl(); }
  [[nodiscard]] const PatchStore& store() const { return *store_; }
  [[nodiscard]] ModelMaps maps() const { return maps_; }

  /// Makes what a part of a picture needs whatever engine draws it. Fails if the part is larger
  /// than OpenGL allows or an environment can't be read.
  Result<GlPicture> make_picture(const RenderSettings& settings, const Raster& part);

  /// The view of a whole picture, one sample a pixel.
  [[nodiscard]] View view_of(const RenderSettings& settings) const;

  /// Draws it (draw_picture), without reading it back. Fails, too, if OpenGL has complained in a
  /// debug context.
  [[nodiscard]] Result<RenderResult> draw(const GlDrawing& drawing,
                                          const RenderSettings& settings) const;

  /// What averages the samples of pixels; made when it is first asked for.
  Result<const Resolve*> resolve();

 private:
  GlModel() = default;
  Result<const Texture*> environment_for(const std::filesystem::path& path, float roughness);
  Result<const Texture*> rough_environments_for(const std::filesystem::path& path,
                                                const std::vector<float>& roughnesses);
  Status add_materials(const RenderSettings& settings, GlPicture& picture);
  Result<const Backdrop*> backdrop(const RenderSettings& settings);

  std::shared_ptr<const OpenGl> opengl_;  ///< first: the last to go
  std::optional<PatchStore> store_;
  std::map<std::pair<std::filesystem::path, float>, Texture> environments_;  ///< by roughness
  std::map<std::pair<std::filesystem::path, std::vector<float>>, Texture> rough_environments_;
  std::map<bool, Backdrop> backdrops_;  ///< by whether the camera is orthographic
  std::optional<Resolve> resolve_;
  ModelMaps maps_{false};
  DepthNeeds depth_needs_;
};

}  // namespace relief

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
#include "renderer/environment.h"
#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl_picture.h"
#include "renderer/patch_store.h"
#include "renderer/render.h"

namespace relief {

/// The context, the model's patches, and the environments that pictures have needed so far. At an
/// address that lasts: what is made with its functions keeps it, and must go before it does.
class GlModel {
 public:
  /// Makes a context and uploads the model's heights and those maps that are needed. All views have
  /// the platform and debug flag of the first.
  static Result<std::unique_ptr<GlModel>> create(const PatchModel& model,
                                                 std::span<const RenderSettings> views,
                                                 const StoreNeeds& needs);

  [[nodiscard]] const Gl& gl() const { return gl_; }
  [[nodiscard]] const PatchStore& store() const { return *store_; }
  [[nodiscard]] bool has_colours() const { return has_colours_; }

  /// Makes what a picture needs whatever engine draws it. Fails if the picture is larger than
  /// OpenGL allows or an environment can't be read.
  Result<GlPicture> make_picture(const RenderSettings& settings);

  /// Draws it (draw_picture). Fails, too, if OpenGL has complained in a debug context.
  [[nodiscard]] Result<RenderResult> draw(const GlPicture& picture, const DrawModel& draw,
                                          const DrawModel& count,
                                          const RenderSettings& settings) const;

 private:
  GlModel() = default;
  Result<const Texture*> environment_for(const std::filesystem::path& path, float roughness);
  Result<const Texture*> rough_environments_for(const std::filesystem::path& path,
                                                const std::vector<float>& roughnesses);
  Status add_materials(const RenderSettings& settings, GlPicture& picture);
  Result<const Backdrop*> backdrop();

  std::unique_ptr<GlContext> context_;  ///< first: the last to go
  Gl gl_;
  std::optional<DebugLog> log_;
  std::optional<PatchStore> store_;
  std::map<std::pair<std::filesystem::path, float>, Texture> environments_;  ///< by roughness
  std::map<std::pair<std::filesystem::path, std::vector<float>>, Texture> rough_environments_;
  std::optional<Backdrop> backdrop_;
  bool has_colours_ = false;
  double near_ = 0.0;
};

}  // namespace relief

#include "viewer/drawing/uploaded_scene.h"

#include <algorithm>
#include <utility>

#include "renderer/frame/features.h"
#include "renderer/frame/gl_frame.h"

namespace relief {
namespace {

/// What decides what is uploaded, and which shaders there are.
std::pair<std::string, std::uint64_t> kind_of(const RenderSettings& look, ModelMaps maps) {
  const EngineEntry* const engine = find_engine(look.engine);
  const bool has_features = engine != nullptr && engine->features != nullptr;
  return {look.engine, has_features ? engine->features(look, maps).bits : 0};
}

/// What OpenGL on the CPU takes is memory, too, and it is to make the largest texture in less than
/// a tenth of a second.
StreamBudget budget_for(StreamBudget budget, const Gl& gl) {
  const bool is_software = renderer_name(gl).find("llvmpipe") != std::string::npos ||
                           renderer_name(gl).find("softpipe") != std::string::npos;
  if (budget.gpu == 0) budget.gpu = is_software ? kSoftwareBudget.gpu : kHardwareBudget.gpu;
  if (budget.memory == 0)
    budget.memory = is_software ? kSoftwareBudget.memory : kHardwareBudget.memory;
  return budget;
}

}  // namespace

UploadedScene::UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene,
                             StreamOptions options)
    : load_(std::move(load)),
      scene_(std::move(scene)),
      forms_(scene_->forms()),
      options_(std::move(options)) {}

Result<std::unique_ptr<UploadedScene>> UploadedScene::create(
    const GlLoader& load, std::shared_ptr<const LoadedScene> scene, const Looks& looks,
    const StreamOptions& options) {
  std::unique_ptr<UploadedScene> made(new UploadedScene(load, std::move(scene), options));
  RELIEF_TRY(made->prepare(looks));
  return made;
}

bool UploadedScene::has(const RenderSettings& look) const {
  const ModelMaps maps(scene_->patches);
  const auto kind = kind_of(look, maps);
  return std::any_of(looks_.begin(), looks_.end(),
                     [&](const RenderSettings& known) { return kind_of(known, maps) == kind; });
}

Status UploadedScene::prepare(const Looks& looks) {
  std::vector<RenderSettings> wanted = looks_;
  if (!has(looks.first)) wanted.push_back(looks.first);
  if (looks.second && !has(*looks.second)) wanted.push_back(*looks.second);
  if (viewport_ != nullptr && wanted.size() == looks_.size()) return {};
  if (scene_->tiles != nullptr) {
    RELIEF_TRY(prepare_stream(wanted));
  } else {
    RELIEF_TRY_ASSIGN(viewport_, Viewport::create(load_, forms_, wanted));
  }
  looks_ = std::move(wanted);
  return {};
}

/// What is read stays for looks that need no more of it than those before.
Status UploadedScene::prepare_stream(const std::vector<RenderSettings>& looks) {
  if (opengl_ == nullptr) {
    RELIEF_TRY_ASSIGN(opengl_, OpenGl::adopt(load_));
  }
  const StoreNeeds needs = pool_needs(scene_->patches, looks);
  std::unique_ptr<StreamedPatches> made;
  if (stream_ == nullptr || needs != stream_needs_) {
    RELIEF_TRY_ASSIGN(made, StreamedPatches::create(opengl_->gl(), scene_->tiles, needs,
                                                    budget_for(options_.budget, opengl_->gl()),
                                                    looks, options_.wake));
  }
  const StreamedPatches& patches = made ? *made : *stream_;
  RELIEF_TRY_ASSIGN(viewport_, Viewport::create(load_, scene_->patches, patches.pool(), looks));
  if (made) stream_ = std::move(made);
  stream_needs_ = needs;
  return {};
}

}  // namespace relief

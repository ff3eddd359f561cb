#include "viewer/drawing/uploaded_scene.h"

#include <algorithm>
#include <utility>

#include "renderer/frame/features.h"

namespace relief {
namespace {

/// What decides what is uploaded, and which shaders there are.
std::pair<std::string, std::uint64_t> kind_of(const RenderSettings& look, ModelMaps maps) {
  const EngineEntry* const engine = find_engine(look.engine);
  const bool has_features = engine != nullptr && engine->features != nullptr;
  return {look.engine, has_features ? engine->features(look, maps).bits : 0};
}

}  // namespace

UploadedScene::UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene)
    : load_(std::move(load)), scene_(std::move(scene)), forms_(scene_->forms()) {}

Result<std::unique_ptr<UploadedScene>> UploadedScene::create(
    const GlLoader& load, std::shared_ptr<const LoadedScene> scene, const Looks& looks) {
  std::unique_ptr<UploadedScene> made(new UploadedScene(load, std::move(scene)));
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
  RELIEF_TRY_ASSIGN(auto viewport, Viewport::create(load_, forms_, wanted));
  viewport_ = std::move(viewport);
  looks_ = std::move(wanted);
  return {};
}

}  // namespace relief

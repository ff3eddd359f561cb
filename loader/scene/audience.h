// Who sees the models of a scene.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "renderer/view/patches_in_view.h"

namespace relief {

/// The views of a scene, as the files of its models need to know them.
class Audience {
 public:
  /// `models` must outlive it. `extent`: of the scene, without patches.
  Audience(const std::vector<SceneModel>& models, std::vector<RenderSettings> views,
           PatchModel extent)
      : models_(models), views_(std::move(views)), extent_(std::move(extent)) {}

  /// Returns each position of a file's models in each view.
  [[nodiscard]] std::vector<Onlooker> of(const std::filesystem::path& path) const {
    std::vector<Transform> positions;
    for (const SceneModel& model : models_) {
      if (model.file == path) positions.push_back(model.transform);
    }
    return onlookers_of(views_, positions, extent_);
  }

 private:
  const std::vector<SceneModel>& models_;
  std::vector<RenderSettings> views_;
  PatchModel extent_;
};

}  // namespace relief

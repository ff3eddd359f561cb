// The cube maps of a model's views, smooth and rough, each made once.
#pragma once

#include <filesystem>
#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/shading/cube_map.h"
#include "renderer/shading/rough_environment.h"

namespace relief {

/// Loads environments when they are first asked for. Pointers stay good while it lives.
class EnvironmentCache {
 public:
  /// See load_environment; with a roughness, what a mirror of that reflects of it.
  Result<const CubeMap*> get(const std::filesystem::path& path, float roughness = 0.0F) {
    const auto found = cubes_.find({path, roughness});
    if (found != cubes_.end()) return &found->second;
    Result<CubeMap> made = roughness > 0.0F ? make_rough(path, roughness) : load_environment(path);
    if (!made) return made.error();
    return &cubes_.emplace(std::pair(path, roughness), std::move(*made)).first->second;
  }

 private:
  Result<CubeMap> make_rough(const std::filesystem::path& path, float roughness) {
    const Result<const CubeMap*> smooth = get(path);
    if (!smooth) return smooth.error();
    return prefilter(**smooth, roughness, rough_size(**smooth, roughness));
  }

  std::map<std::pair<std::filesystem::path, float>, CubeMap> cubes_;
};

}  // namespace relief

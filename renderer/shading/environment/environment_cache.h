// The cube maps of a model's views, smooth and rough, each made once.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/shading/environment/cube_map.h"
#include "renderer/shading/environment/irradiance.h"
#include "renderer/shading/environment/rough_environment.h"

namespace relief {

/// Loads environments when they are first asked for. Pointers stay good while it lives.
class EnvironmentCache {
 public:
  /// See load_environment; with a roughness, what a mirror of that reflects of it.
  Result<const CubeMap*> get(const std::filesystem::path& path, float roughness = 0.0F) {
    const auto found = cubes_.find({path, roughness});
    if (found != cubes_.end()) return &found->second;
    RELIEF_TRY_ASSIGN(CubeMap made,
                      roughness > 0.0F ? make_rough(path, roughness) : load_environment(path));
    return &cubes_.emplace(std::pair(path, roughness), std::move(made)).first->second;
  }

  /// What surfaces scatter of an environment (irradiance_of).
  Result<std::array<glm::vec4, 9>> irradiance(const std::filesystem::path& path) {
    const auto found = irradiances_.find(path);
    if (found != irradiances_.end()) return found->second;
    RELIEF_TRY_ASSIGN(const CubeMap* cube, get(path));
    return irradiances_.emplace(path, irradiance_of(*cube)).first->second;
  }

 private:
  Result<CubeMap> make_rough(const std::filesystem::path& path, float roughness) {
    RELIEF_TRY_ASSIGN(const CubeMap* smooth, get(path));
    return prefilter(*smooth, roughness, rough_size(*smooth, roughness));
  }

  std::map<std::pair<std::filesystem::path, float>, CubeMap> cubes_;
  std::map<std::filesystem::path, std::array<glm::vec4, 9>> irradiances_;
};

}  // namespace relief

// The cube maps of a model's views, each made once.
#pragma once

#include <filesystem>
#include <map>

#include "common/error.h"
#include "renderer/cube_map.h"

namespace relief {

/// Loads environments when they are first asked for. Pointers stay good while it lives.
class EnvironmentCache {
 public:
  /// See load_environment.
  Result<const CubeMap*> get(const std::filesystem::path& path) {
    auto found = cubes_.find(path);
    if (found == cubes_.end()) {
      Result<CubeMap> made = load_environment(path);
      if (!made) return made.error();
      found = cubes_.emplace(path, std::move(*made)).first;
    }
    return &found->second;
  }

 private:
  std::map<std::filesystem::path, CubeMap> cubes_;
};

}  // namespace relief

// The variants of an engine that pictures have needed so far.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/gl_model.h"

namespace relief {

/// Engines of one kind by their feature bits: Engine::create(gl, store, features) makes one.
template <class Engine>
class EngineCache {
 public:
  /// The variant, made now if no picture has needed it before; it lives as long as the cache.
  Result<const Engine*> get(const GlModel& model, std::uint32_t features) {
    auto found = engines_.find(features);
    if (found == engines_.end()) {
      Result<Engine> made = Engine::create(model.gl(), model.store(), features);
      if (!made) return made.error();
      found = engines_.emplace(features, std::move(*made)).first;
    }
    return &found->second;
  }

 private:
  std::map<std::uint32_t, Engine> engines_;
};

}  // namespace relief

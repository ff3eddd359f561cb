// The variants of an engine that pictures have needed so far.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/frame/gl_image.h"
#include "renderer/frame/gl_model.h"
#include "shaders/include/shared.h"

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

  /// `picture` drawn by a variant, and by the one that counts its fragments if `counts`.
  /// draw_with(engine) gives what draws with an engine.
  template <class DrawWith>
  Result<GlDrawing> make_drawing(const GlModel& model, std::uint32_t features, GlPicture picture,
                                 bool counts, const DrawWith& draw_with) {
    const auto engine = get(model, features);
    if (!engine) return engine.error();
    GlDrawing drawing{std::move(picture), draw_with(**engine), {}};
    if (!counts) return drawing;
    const auto counting = get(model, features | RELIEF_FEATURE_COUNT_FRAGMENTS);
    if (!counting) return counting.error();
    drawing.count = draw_with(**counting);
    return drawing;
  }

 private:
  std::map<std::uint32_t, Engine> engines_;
};

}  // namespace relief

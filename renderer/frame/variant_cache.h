// The shader variants of an engine that images have needed so far.
#pragma once

#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/frame/gl_model.h"
#include "renderer/gl/features.h"

namespace relief {

/// Variants of one engine by their feature bits: Variant::create(gl, store, features) makes one.
template <class Variant>
class VariantCache {
 public:
  /// The variant, made now if no image has needed it before; it lives as long as the cache.
  Result<const Variant*> get(const GlModel& model, Features features) {
    auto found = variants_.find(features);
    if (found == variants_.end()) {
      if (const char* const contradiction = contradiction_in(features))
        return make_error("{}; this is a mistake in Relief", contradiction);
      RELIEF_TRY_ASSIGN(Variant made, Variant::create(model.gl(), model.store(), features));
      found = variants_.emplace(features, std::move(made)).first;
    }
    return &found->second;
  }

 private:
  std::map<Features, Variant> variants_;
};

}  // namespace relief

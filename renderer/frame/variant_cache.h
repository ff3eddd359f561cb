// The shader variants of an engine that images have needed so far.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "common/error.h"
#include "renderer/frame/gl_model.h"
#include "renderer/gl/shader/features.h"

namespace relief {

/// Variants of one engine by their feature bits: Variant::create(gl, store, features) makes one,
/// whose `samples` are its SampleDraws.
template <class Variant>
class VariantCache {
 public:
  /// The variant, made now if no image has needed it before; it lives until the
  /// next call for the same.
  Result<const Variant*> get(const GlModel& model, Features features) {
    const PatchStore& store = model.store();
    auto found = variants_.find(features);
    if (found != variants_.end() && found->second.programs_version != store.programs_version) {
      variants_.erase(found);
      found = variants_.end();
    }
    if (found == variants_.end()) {
      if (const char* const contradiction = contradiction_in(features))
        return make_error("{}; this is a mistake in Relief", contradiction);
      RELIEF_TRY_ASSIGN(Variant made, Variant::create(model.gl(), store, features));
      found = variants_
                  .emplace(features,
                           Made{std::move(made), store.programs_version, store.buffers_version})
                  .first;
    }
    Made& made = found->second;
    if (made.buffers_version != store.buffers_version) {
      made.variant.samples.renew();
      made.buffers_version = store.buffers_version;
    }
    return &made.variant;
  }

 private:
  /// A variant, and what the store was when it was made.
  struct Made {
    Variant variant;
    std::uint32_t programs_version = 0;
    std::uint32_t buffers_version = 0;
  };
  std::map<Features, Made> variants_;
};

}  // namespace relief

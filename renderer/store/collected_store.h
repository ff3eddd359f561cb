// A model on its way to the GPU: all that needs no OpenGL, made on any thread.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "renderer/store/collect_model.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/view.h"

namespace relief {

/// What a store is made for.
struct StoreOrder {
  StoreNeeds needs;
  std::vector<View> views;
  bool all_levels = false;  ///< also those that none of the views chooses
};

/// Lists and pages of a PatchStore. Collecting them is nine tenths of the time of an upload: of the
/// Dragon's samples 1.03 of 1.15 s. The model outlives it.
class CollectedStore {
 public:
  /// Fails if OpenGL can't draw as many samples, or if it is stopped.
  static Result<std::unique_ptr<CollectedStore>> collect(const StoreLimits& limits,
                                                         const PatchModel& model, StoreOrder order,
                                                         const std::stop_token& stop = {});

  /// Whether it serves another order, if both are for all levels: of its views only what is made of
  /// any of them counts.
  [[nodiscard]] bool serves(const StoreOrder& order) const;

  /// Uploads it, once. Fails if OpenGL lacks memory or a map is larger than it allows.
  Result<PatchStore> upload(const Gl& gl);

 private:
  CollectedStore(const StoreLimits& limits, const PatchModel& model, StoreOrder order)
      : order_(std::move(order)),
        collector_(limits, model, order_.needs, {order_.views, order_.all_levels}) {}
  StoreOrder order_;  ///< first: the collector refers to it
  ModelCollector collector_;
};

}  // namespace relief

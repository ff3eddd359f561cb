// The shader programs of the engine `surfel`.
#pragma once

#include <array>
#include <optional>

#include "common/error.h"
#include "renderer/engines/surfel/select_surfels.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/shader/features.h"

namespace relief::surfel {

/// The two passes over surfels of a kind.
struct SurfelPrograms {
  Program visibility;
  Program accumulation;
};

/// The programs of some features, each made when the first frame needs it: that most frames have no
/// curved surfel should cost them nothing.
class Programs {
 public:
  Programs(const Gl& gl, Features features) : gl_(&gl), features_(features) {}

  Result<const SurfelPrograms*> of(const SurfelKind& kind);
  Result<const Program*> shading();
  [[nodiscard]] Features features() const { return features_; }

 private:
  const Gl* gl_;
  Features features_;
  std::array<std::optional<SurfelPrograms>, kSurfelKinds.size()> of_kinds_;
  std::optional<Program> shading_;
};

/// The features of what is summed up, from which the sums and the last pass follow: where surfels
/// are blended one over the other they are shaded before, and are no more than colours.
[[nodiscard]] Features summed_features(Features features);

}  // namespace relief::surfel

// What an engine implements.
#pragma once

#include "common/error.h"
#include "common/progress.h"
#include "renderer/render.h"

namespace relief {

/// A model that an engine has made ready for any number of pictures: what does not depend on the
/// view is made when this is made (the model on the GPU, a tree over triangles, a cloud of splats),
/// or by the first picture that needs it. The model outlives it. Used from one thread, that which
/// made it.
class PreparedModel {
 public:
  PreparedModel() = default;
  virtual ~PreparedModel() = default;
  PreparedModel(const PreparedModel&) = delete;
  PreparedModel& operator=(const PreparedModel&) = delete;

  /// One picture, the same as if it were the only one. `settings` are among those that the model
  /// was prepared for.
  virtual Result<RenderResult> render(const RenderSettings& settings, Progress& progress) = 0;
};

}  // namespace relief

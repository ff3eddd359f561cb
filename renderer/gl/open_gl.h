// OpenGL made ready: a context and its functions.
#pragma once

#include <memory>
#include <optional>

#include "common/error.h"
#include "renderer/gl/context/context.h"
#include "renderer/gl/context/loader.h"
#include "renderer/gl/context/platform.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/recorder.h"

namespace relief {

/// A context, shared by all that is made in it. At an address that lasts.
class OpenGl {
 public:
  /// With `records`, everything that is made and drawn in it is kept track of.
  static Result<std::shared_ptr<const OpenGl>> create(GlPlatform platform, bool debug,
                                                      bool records);

  /// The functions of the context that is current, which stays its owner's.
  static Result<std::shared_ptr<const OpenGl>> adopt(const GlLoader& load);

  [[nodiscard]] const Gl& gl() const { return gl_; }

  /// Fails if OpenGL has complained in a debug context.
  [[nodiscard]] Status status() const { return log_ ? log_->status() : Status(); }

 private:
  OpenGl() = default;

  std::unique_ptr<GlContext> context_;  ///< first: the last to go
  std::optional<GlRecorder> recorder_;
  Gl gl_;
  std::optional<DebugLog> log_;
};

}  // namespace relief

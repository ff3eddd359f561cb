// Where OpenGL comes from: a context without a window, current on the thread that made it.
#pragma once

#include <memory>
#include <string>

#include "common/error.h"
#include "renderer/gl/context/loader.h"
#include "renderer/gl/context/platform.h"

namespace relief {

/// An OpenGL 4.5 core context. It is current from its creation to its destruction, which happens on
/// the same thread; objects made in it must be gone before it.
class GlContext {
 public:
  GlContext() = default;
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// The address of an OpenGL function, or null.
  [[nodiscard]] virtual GlFunction get_proc_address(const char* name) const = 0;
  /// What gave the context, for messages: "EGL", "OSMesa".
  [[nodiscard]] virtual const char* name() const = 0;
};

/// Makes a context of the platform asked for; Automatic tries EGL, then OSMesa. A failure is one
/// sentence that says what was tried and which Debian packages bring it.
Result<std::unique_ptr<GlContext>> make_context(GlPlatform platform, bool debug);

/// A context that someone else owns, current now and as long as this lives: nothing is made
/// current, and nothing destroyed.
std::unique_ptr<GlContext> adopt_context(const GlLoader& load);

/// The single platforms. Their errors are clauses without advice ("EGL: ...").
Result<std::unique_ptr<GlContext>> make_egl_context(bool debug);
Result<std::unique_ptr<GlContext>> make_osmesa_context(bool debug);

}  // namespace relief

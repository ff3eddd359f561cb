// An OpenGL context of a test's own, without a window.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "renderer/gl/context/context.h"
#include "renderer/gl/context/loader.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/functions.h"

namespace relief::test {

/// A context that is current as long as this lives. The test fails if there is none, or if OpenGL
/// has complained when it goes. Pinned.
class OwnContext {
 public:
  OwnContext() : context_(must(make_context(GlPlatform::Automatic, true))) {}
  ~OwnContext() {
    const Status status = log_.status();
    EXPECT_TRUE(status) << status.error().message;
  }
  OwnContext(const OwnContext&) = delete;
  OwnContext& operator=(const OwnContext&) = delete;

  [[nodiscard]] GlLoader loader() const {
    return [this](const char* name) { return context_->get_proc_address(name); };
  }
  [[nodiscard]] const Gl& gl() const { return gl_; }

 private:
  template <class T>
  static T must(Result<T> result) {
    EXPECT_TRUE(result) << (result ? std::string() : result.error().message);
    return *std::move(result);
  }

  std::unique_ptr<GlContext> context_;
  Gl gl_ = must(load_functions(*context_));
  DebugLog log_{gl_};
};

}  // namespace relief::test

// What OpenGL complains about.
#pragma once

#include <string>

#include "common/error.h"
#include "renderer/gl/functions.h"

namespace relief {

/// Collects the messages of a debug context for as long as it lives. Pinned: OpenGL holds its
/// address.
class DebugLog {
 public:
  explicit DebugLog(const Gl& gl);
  ~DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  /// Fails with the first message of high severity, if there was one.
  [[nodiscard]] Status status() const;

 private:
  const Gl& gl_;
  std::string first_;
};

}  // namespace relief

// Shared libraries opened while running, so that a machine without them still runs the rest.
#pragma once

#include <dlfcn.h>

#include "common/error.h"

namespace relief {

/// A shared library. It stays loaded until the process ends: OpenGL libraries keep threads and
/// handlers of their own that would outlive it.
class Library {
 public:
  /// Fails with what the loader says.
  static Result<Library> open(const char* name) {
    void* handle = ::dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr) return Error{::dlerror()};  // NOLINT(concurrency-mt-unsafe)
    return Library(handle);
  }

  /// Sets `function` to the symbol `name`, or null.
  template <class Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(::dlsym(handle_, name));
  }

 private:
  explicit Library(void* handle) : handle_(handle) {}
  void* handle_;
};

}  // namespace relief

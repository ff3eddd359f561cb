// Work that goes on while a thread does something else.
#pragma once

#include <tbb/task_group.h>

namespace relief {

/// Tasks that end before this does: a member that comes after all that they write. What is left of
/// them when it ends is cancelled, and its errors are dropped, as one is already being returned.
class BackgroundTasks {
 public:
  BackgroundTasks() = default;
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;
  ~BackgroundTasks() {
    tasks_.cancel();
    try {
      tasks_.wait();
    } catch (...) {  // NOLINT: see above
    }
  }

  template <class Task>
  void run(const Task& task) {
    tasks_.run(task);
  }

  /// Waits for all; throws what one of them threw.
  void wait() { tasks_.wait(); }

 private:
  tbb::task_group tasks_;
};

}  // namespace relief

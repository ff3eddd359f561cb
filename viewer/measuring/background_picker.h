// A SurfacePicker that is made on a thread of its own.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "common/patch.h"
#include "viewer/measuring/surface_pick.h"

namespace relief {

/// The picker of the model that a window shows. Its functions are called from one thread.
class BackgroundPicker {
 public:
  /// `wake` is called on another thread when a picker is ready.
  explicit BackgroundPicker(std::function<void()> wake);

  /// Waits for the picker that is being made, which cannot be cancelled: up to a second for the
  /// Dragon.
  ~BackgroundPicker();
  BackgroundPicker(const BackgroundPicker&) = delete;
  BackgroundPicker& operator=(const BackgroundPicker&) = delete;

  /// Begins to make the picker of another model, which is kept alive as long as that takes; null:
  /// of none. Does nothing if it is the same model.
  void set_model(std::shared_ptr<const PatchModel> model);

  /// Drops the picker of any other model. Makes none.
  void keep_only(const PatchModel* model);

  /// Returns the picker of the model that was set last; null until it is ready.
  [[nodiscard]] std::shared_ptr<const SurfacePicker> ready() const;

 private:
  void run(const std::stop_token& stop);

  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const PatchModel> model_;     ///< that was set last
  bool is_new_ = false;                         ///< the thread has not seen model_ yet
  std::shared_ptr<const SurfacePicker> ready_;  ///< of model_
  std::jthread thread_;                         ///< last: it uses all others
};

}  // namespace relief

#include "viewer/measuring/background_picker.h"

#include <new>
#include <utility>

namespace relief {
namespace {

/// A picker and the model that must outlive it.
struct Made {
  explicit Made(std::shared_ptr<const PatchModel> shown)
      : model(std::move(shown)), picker(*model) {}
  std::shared_ptr<const PatchModel> model;
  SurfacePicker picker;
};

}  // namespace

BackgroundPicker::BackgroundPicker(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

BackgroundPicker::~BackgroundPicker() = default;

void BackgroundPicker::set_model(std::shared_ptr<const PatchModel> model) {
  std::shared_ptr<const SurfacePicker> before;  // goes without the lock
  {
    const std::lock_guard lock(mutex_);
    if (model == model_) return;
    model_ = std::move(model);
    is_new_ = true;
    before = std::exchange(ready_, nullptr);
  }
  changed_.notify_one();
}

void BackgroundPicker::keep_only(const PatchModel* model) {
  if (model_.get() != model) set_model(nullptr);  // only this thread sets it
}

std::shared_ptr<const SurfacePicker> BackgroundPicker::ready() const {
  const std::lock_guard lock(mutex_);
  return ready_;
}

void BackgroundPicker::run(const std::stop_token& stop) {
  while (true) {
    std::shared_ptr<const PatchModel> model;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, stop, [this] { return is_new_; })) return;
      is_new_ = false;
      model = model_;
    }
    if (model == nullptr) continue;
    std::shared_ptr<const Made> made;
    try {
      made = std::make_shared<const Made>(model);
    } catch (const std::bad_alloc&) {
      continue;  // picks stay as precise as depths on the GPU
    }
    {
      const std::lock_guard lock(mutex_);
      if (model_ != model) continue;
      ready_ = std::shared_ptr<const SurfacePicker>(made, &made->picker);
    }
    wake_();
  }
}

}  // namespace relief

// The progress of a job that another thread looks at.
#pragma once

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/progress.h"

namespace relief {

/// How far a job is.
struct JobProgress {
  std::string stage;            ///< empty before the first
  std::optional<double> share;  ///< of the stage, 0 to 1; none if unknown
};

/// Keeps what a job reports until it is asked for. All functions are thread-safe.
class WatchedProgress final : public Progress {
 public:
  void begin_stage(std::string_view name, std::uint64_t units) override {
    const std::lock_guard lock(mutex_);
    stage_ = name;
    units_ = units;
    done_ = 0;
  }
  void advance(std::uint64_t units) override { done_ += units; }
  void note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    notes_.emplace_back(text);
  }
  [[nodiscard]] bool cancelled() const override { return cancelled_; }

  void cancel() { cancelled_ = true; }
  [[nodiscard]] JobProgress progress() const {
    const std::lock_guard lock(mutex_);
    JobProgress progress{stage_, {}};
    if (units_ > 0) {
      const double share = static_cast<double>(done_.load()) / static_cast<double>(units_);
      progress.share = std::min(1.0, share);
    }
    return progress;
  }
  /// Returns what was noted since the last call.
  [[nodiscard]] std::vector<std::string> take_notes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notes_, {});
  }

 private:
  mutable std::mutex mutex_;
  std::string stage_;
  std::uint64_t units_ = 0;
  std::vector<std::string> notes_;
  std::atomic<std::uint64_t> done_ = 0;
  std::atomic<bool> cancelled_ = false;
};

}  // namespace relief

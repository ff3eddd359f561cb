// Progress of a long job on standard error.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "common/progress.h"

namespace relief::cli {

/// How far a stage is.
struct StageState {
  std::string_view name;
  std::uint64_t done = 0;
  std::uint64_t units = 0;  ///< 0: unknown
  double seconds = 0.0;     ///< since it began
};

/// "resample 40 %, 12 s left", or "neighbours, 20 s so far" if it cannot be known.
[[nodiscard]] std::string progress_text(const StageState& stage);

/// Prints notes, and the progress: one line with a bar that is drawn over and over, or, where no
/// bar can be drawn, a line now and then. A short job prints no such line. Keeps how long each
/// stage took.
class ConsoleProgress final : public Progress {
 public:
  struct Stage {
    std::string name;
    double seconds = 0.0;
  };

  /// Seldom enough for a log, often enough for one who waits.
  static constexpr auto kLineInterval = std::chrono::seconds(10);

  explicit ConsoleProgress(std::chrono::milliseconds line_interval = kLineInterval);
  ~ConsoleProgress() override;

  void begin_stage(std::string_view name, std::uint64_t units) override;
  void advance(std::uint64_t units) override;
  /// Prints the note in a line of its own.
  void note(std::string_view text) override;
  [[nodiscard]] bool cancelled() const override;

  /// Ends the last stage, wipes the line and returns all stages in their order; stages with the
  /// same name are added up.
  const std::vector<Stage>& finish();

 private:
  using Clock = std::chrono::steady_clock;

  void end_stage(Clock::time_point now);
  void draw(Clock::time_point now);
  void wipe();
  void tick(const std::stop_token& stop, std::chrono::milliseconds interval);
  [[nodiscard]] StageState state(Clock::time_point now) const;

  const bool bars_;
  std::mutex mutex_;  ///< guards all below except done_ and next_draw_
  std::vector<Stage> stages_;
  std::string stage_;
  std::uint64_t units_ = 0;
  Clock::time_point stage_start_;
  bool line_drawn_ = false;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<Clock::rep> next_draw_{0};
  std::condition_variable_any ended_;
  std::jthread ticker_;  ///< reports also where a stage does not; the last member, so it ends first
};

}  // namespace relief::cli

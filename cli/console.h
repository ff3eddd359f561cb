// The command's input and output: prints results on standard output and everything else on standard
// error, and lets long jobs see that the user pressed Ctrl-C.
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/progress.h"

namespace relief::cli {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;

/// Installs the signal handlers. The first SIGINT or SIGTERM is remembered (see interrupted) and
/// the second one ends the process. A write beyond the file size limit fails like a full disk.
void handle_signals();

/// Returns true after an interrupt by the user.
[[nodiscard]] bool interrupted();

/// Prints `error` in one line on standard error and returns kFailed. After an interrupt it prints
/// "interrupted" instead, because that made the job fail. `kept`: the files written before, if any
/// ("2 of 12 images were written").
int fail(const Error& error, std::string_view kept = {});

/// Prints a result on standard output and returns the exit code: kFailed, with a sentence, if
/// standard output cannot be written (full disk).
int print_result(std::string_view text);
int print_json(const nlohmann::ordered_json& result);

/// Prepares standard input if "-" is among the inputs (common/io/standard_input.h).
Status open_inputs(const std::vector<std::filesystem::path>& inputs);

/// Prints the progress of a long job on standard error: notes, and one line with a bar and the time
/// left if standard error is a terminal. Keeps how long each stage took.
class ConsoleProgress final : public Progress {
 public:
  struct Stage {
    std::string name;
    double seconds = 0.0;
  };

  ConsoleProgress();
  ~ConsoleProgress() override;

  void begin_stage(std::string_view name, std::uint64_t units) override;
  void advance(std::uint64_t units) override;
  /// Prints the note in a line of its own.
  void note(std::string_view text) override;
  [[nodiscard]] bool cancelled() const override { return interrupted(); }

  /// Ends the last stage, wipes the line and returns all stages in their order; stages with the
  /// same name are added up.
  const std::vector<Stage>& finish();

 private:
  using Clock = std::chrono::steady_clock;

  void end_stage(Clock::time_point now);
  void draw(Clock::time_point now);

  const bool on_terminal_;
  std::mutex mutex_;  ///< guards all below except done_ and next_draw_
  std::vector<Stage> stages_;
  std::string stage_;
  std::uint64_t units_ = 0;
  Clock::time_point stage_start_;
  bool line_drawn_ = false;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<Clock::rep> next_draw_{0};
};

}  // namespace relief::cli

#include "cli/console.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "common/io/standard_input.h"

namespace relief::cli {
namespace {

// A signal handler can reach nothing but a global; this is the only one in the project.
volatile std::sig_atomic_t g_interrupted = 0;

extern "C" void remember_interrupt(int /*signal*/) {
  g_interrupted = 1;
}

constexpr auto kDrawInterval = std::chrono::milliseconds(100);
constexpr int kBarCells = 30;

std::string time_left(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s left", whole);
  return fmt::format("{} min {:02} s left", whole / 60, whole % 60);
}

}  // namespace

void handle_signals() {
  struct sigaction action {};
  action.sa_handler = remember_interrupt;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, nullptr);
}

bool interrupted() {
  return g_interrupted != 0;
}

int fail(const Error& error, std::string_view kept) {
  if (interrupted()) {
    fmt::print(stderr, "relief: interrupted; {}\n", kept.empty() ? "nothing was written" : kept);
  } else {
    fmt::print(stderr, "relief: {}{}{}\n", error.message, kept.empty() ? "" : "; ", kept);
  }
  return kFailed;
}

int print_result(std::string_view text) {
  // Not fmt::print: it throws where standard output is full.
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return written ? kDone : fail(Error{"standard output: can't be written; is the disk full?"});
}

int print_json(const nlohmann::ordered_json& result) {
  return print_result(result.dump(2) + "\n");
}

Status open_inputs(const std::vector<std::filesystem::path>& inputs) {
  if (std::ranges::find(inputs, kStandardName) == inputs.end()) return {};
  ConsoleProgress progress;
  return spool_standard_input(progress);
}

ConsoleProgress::ConsoleProgress()
    : on_terminal_(isatty(STDERR_FILENO) == 1), stage_start_(Clock::now()) {}

ConsoleProgress::~ConsoleProgress() {
  finish();
}

void ConsoleProgress::begin_stage(std::string_view name, std::uint64_t units) {
  const std::lock_guard lock(mutex_);
  const auto now = Clock::now();
  end_stage(now);
  stage_ = name;
  units_ = units;
  stage_start_ = now;
  done_ = 0;
  draw(now);
}

void ConsoleProgress::advance(std::uint64_t units) {
  done_ += units;
  if (!on_terminal_) return;
  const auto now = Clock::now();
  if (now.time_since_epoch().count() < next_draw_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) draw(now);
}

void ConsoleProgress::note(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (line_drawn_) fmt::print(stderr, "\r\x1b[K");
  line_drawn_ = false;
  fmt::print(stderr, "relief: {}\n", text);
}

const std::vector<ConsoleProgress::Stage>& ConsoleProgress::finish() {
  const std::lock_guard lock(mutex_);
  end_stage(Clock::now());
  stage_.clear();
  if (line_drawn_) fmt::print(stderr, "\r\x1b[K");
  line_drawn_ = false;
  return stages_;
}

void ConsoleProgress::end_stage(Clock::time_point now) {
  if (stage_.empty()) return;
  const double seconds = std::chrono::duration<double>(now - stage_start_).count();
  const auto known = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const Stage& s) { return s.name == stage_; });
  if (known == stages_.end()) {
    stages_.push_back({stage_, seconds});
  } else {
    known->seconds += seconds;
  }
}

void ConsoleProgress::draw(Clock::time_point now) {
  if (!on_terminal_) return;
  next_draw_ = (now + kDrawInterval).time_since_epoch().count();
  line_drawn_ = true;
  if (units_ == 0) {
    fmt::print(stderr, "\r\x1b[K{:<12} ...", stage_);
    return;
  }
  const double share =
      std::min(1.0, static_cast<double>(done_.load()) / static_cast<double>(units_));
  const int full = static_cast<int>(share * kBarCells);
  const double elapsed = std::chrono::duration<double>(now - stage_start_).count();
  fmt::print(stderr, "\r\x1b[K{:<12} [{:#<{}}{:.<{}}] {:3.0f} %", stage_, "", full, "",
             kBarCells - full, 100.0 * share);
  // The first moments of a stage say little about its length.
  if (share > 0.02 && elapsed > 0.5) {
    fmt::print(stderr, "  {}", time_left(elapsed * (1.0 - share) / share));
  }
}

}  // namespace relief::cli

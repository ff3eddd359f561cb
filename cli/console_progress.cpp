#include "cli/console_progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/interrupt.h"
#include "cli/messages.h"

namespace relief::cli {
namespace {

constexpr auto kDrawInterval = std::chrono::milliseconds(100);
constexpr auto kRedrawInterval = std::chrono::milliseconds(1000);
constexpr int kBarCells = 30;

std::string duration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

double share_of(const StageState& stage) {
  return stage.units == 0
             ? 0.0
             : std::min(1.0, static_cast<double>(stage.done) / static_cast<double>(stage.units));
}

/// ", 12 s left"; empty while the stage is too young to know.
std::string time_left(const StageState& stage, std::string_view before) {
  const double share = share_of(stage);
  // The first moments of a stage say little about its length.
  if (share <= 0.02 || stage.seconds <= 0.5) return {};
  return fmt::format("{}{} left", before, duration(stage.seconds * (1.0 - share) / share));
}

}  // namespace

std::string progress_text(const StageState& stage) {
  const double share = share_of(stage);
  if (stage.done == 0 || stage.units == 0)
    return fmt::format("{}, {} so far", stage.name, duration(stage.seconds));
  return fmt::format("{} {:.0f} %{}", stage.name, 100.0 * share, time_left(stage, ", "));
}

ConsoleProgress::ConsoleProgress(std::chrono::milliseconds line_interval)
    : bars_(shows_bars(STDERR_FILENO)),
      stage_start_(Clock::now()),
      ticker_([this, interval = bars_ ? kRedrawInterval : line_interval](
                  const std::stop_token& stop) { tick(stop, interval); }) {}

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
  if (!bars_) return;
  const auto now = Clock::now();
  if (now.time_since_epoch().count() < next_draw_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) draw(now);
}

void ConsoleProgress::note(std::string_view text) {
  const std::lock_guard lock(mutex_);
  wipe();
  print_message(text);
}

bool ConsoleProgress::cancelled() const {
  return interrupted();
}

const std::vector<ConsoleProgress::Stage>& ConsoleProgress::finish() {
  const std::lock_guard lock(mutex_);
  end_stage(Clock::now());
  stage_.clear();
  wipe();
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

StageState ConsoleProgress::state(Clock::time_point now) const {
  return {stage_, done_.load(), units_, std::chrono::duration<double>(now - stage_start_).count()};
}

void ConsoleProgress::wipe() {
  if (line_drawn_) std::fputs(kWipeLine, stderr);
  line_drawn_ = false;
}

void ConsoleProgress::tick(const std::stop_token& stop, std::chrono::milliseconds interval) {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, stop, interval, [&] { return stop.stop_requested(); })) {
    if (stage_.empty()) continue;
    if (bars_) {
      draw(Clock::now());
    } else {
      print_message(progress_text(state(Clock::now())));
    }
  }
}

void ConsoleProgress::draw(Clock::time_point now) {
  if (!bars_) return;
  next_draw_ = (now + kDrawInterval).time_since_epoch().count();
  line_drawn_ = true;
  const StageState stage = state(now);
  std::string line;
  if (units_ == 0) {
    line = fmt::format("{}{:<12} ...", kWipeLine, stage_);
    if (stage.seconds > 1.0) line += fmt::format("  {} so far", duration(stage.seconds));
  } else {
    const double share = share_of(stage);
    const int full = static_cast<int>(share * kBarCells);
    line = fmt::format("{}{:<12} [{:#<{}}{:.<{}}] {:3.0f} %{}", kWipeLine, stage_, "", full, "",
                       kBarCells - full, 100.0 * share, time_left(stage, "  "));
  }
  std::fputs(line.c_str(), stderr);
}

}  // namespace relief::cli

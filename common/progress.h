// Progress of long jobs, and cancellation.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

#include "common/error.h"

namespace relief {

/// Receives the progress of a long job. The base class ignores it; the command line draws a bar. A
/// job calls `begin_stage` from one thread, `advance` from any thread, and checks `cancelled` at
/// least every few hundred milliseconds of work; it then returns `interrupted_error()`.
class Progress {
 public:
  Progress() = default;
  virtual ~Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts a stage of `units` units of work (0: unknown).
  virtual void begin_stage(std::string_view /*name*/, std::uint64_t /*units*/) {}
  /// Adds finished units of the current stage. Thread-safe.
  virtual void advance(std::uint64_t /*units*/) {}
  /// Reports a condition that the user should know while the job goes on, as one clause ("only some
  /// of the scans have colours; they are left out"). Called from one thread.
  virtual void note(std::string_view /*text*/) {}
  /// Returns whether the user interrupted the job. Thread-safe.
  [[nodiscard]] virtual bool cancelled() const { return false; }
};

/// The progress of a nested job whose stages, units and notes are not reported. Forwards only
/// cancellation.
class QuietProgress final : public Progress {
 public:
  explicit QuietProgress(const Progress& outer) : outer_(outer) {}
  [[nodiscard]] bool cancelled() const override { return outer_.cancelled(); }

 private:
  const Progress& outer_;
};

/// The progress of a part of a job. Forwards units, notes and cancellation, not stages.
class PartProgress final : public Progress {
 public:
  explicit PartProgress(Progress& outer) : outer_(outer) {}
  void note(std::string_view text) override { outer_.note(text); }
  void advance(std::uint64_t units) override { outer_.advance(units); }
  [[nodiscard]] bool cancelled() const override { return outer_.cancelled(); }

 private:
  Progress& outer_;
};

/// Returns the error of a job that the user interrupted.
[[nodiscard]] inline Error interrupted_error() {
  return Error{"interrupted"};
}

}  // namespace relief

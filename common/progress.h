// How a long job reports what it does, and how it is asked to stop.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

#include "common/error.h"

namespace relief {

/// Receives the progress of a long job. The base class ignores it; the command line draws a bar.
/// A job calls `begin_stage` from one thread, `advance` from any, and looks at `cancelled`
/// at least every few hundred milliseconds of work; it then returns `interrupted_error()`.
class Progress {
 public:
  Progress() = default;
  virtual ~Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A new stage starts; `units` is how much work it has (0: not known).
  virtual void begin_stage(std::string_view /*name*/, std::uint64_t /*units*/) {}
  /// `units` more of the current stage are done. Thread-safe.
  virtual void advance(std::uint64_t /*units*/) {}
  /// Something that the user should know although the job goes on, as one clause ("only some of the
  /// scans have colours; they are left out"). Called from one thread.
  virtual void note(std::string_view /*text*/) {}
  /// True once the user asked to stop. Thread-safe.
  [[nodiscard]] virtual bool cancelled() const { return false; }
};

/// The progress of a job within another one. Hides its stages, units and notes; passes on that the
/// user wants to stop.
class QuietProgress final : public Progress {
 public:
  explicit QuietProgress(const Progress& outer) : outer_(outer) {}
  [[nodiscard]] bool cancelled() const override { return outer_.cancelled(); }

 private:
  const Progress& outer_;
};

/// The progress of a part of a job. Hides its stages; its units are units of the outer job.
class PartProgress final : public Progress {
 public:
  explicit PartProgress(Progress& outer) : outer_(outer) {}
  void note(std::string_view text) override { outer_.note(text); }
  void advance(std::uint64_t units) override { outer_.advance(units); }
  [[nodiscard]] bool cancelled() const override { return outer_.cancelled(); }

 private:
  Progress& outer_;
};

/// The error that a job returns when it was asked to stop.
[[nodiscard]] inline Error interrupted_error() {
  return Error{"interrupted"};
}

}  // namespace relief

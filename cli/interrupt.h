// Ctrl-C: jobs see it and end; a call that cannot see it is ended with the process.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace relief::cli {

/// How long a job may take to see an interrupt. Then the process ends where it is, because a call
/// into a driver or a library cannot be asked to stop. Together with leaving the process this is
/// half a second.
inline constexpr auto kInterruptGrace = std::chrono::milliseconds(300);

/// Installs the signal handlers. The first SIGINT, SIGTERM or SIGHUP is remembered (see
/// interrupted), and the process ends kInterruptGrace later at the latest, with the same message
/// and exit code, unless all outputs are complete; the second one ends it at once. A write beyond
/// the file size limit fails like a full disk, and one to a pipe that nobody reads fails instead of
/// ending the process.
void handle_signals();

/// Returns true after an interrupt by the user.
[[nodiscard]] bool interrupted();

/// While it lives: what becomes of files if the process is ended by kInterruptGrace. At most one at
/// a time.
class InterruptedFiles {
 public:
  /// `outputs`: what is being written; unfinished files beside them are removed. `kept`: returns
  /// what to say of finished files, empty if there are none; called on another thread.
  InterruptedFiles(std::vector<std::filesystem::path> outputs, std::function<std::string()> kept);
  /// Says that all outputs are in their place. From then on the process is not ended: only the
  /// report is left, and a failure would be untrue.
  static void note_complete();

  InterruptedFiles(const InterruptedFiles&) = delete;
  InterruptedFiles& operator=(const InterruptedFiles&) = delete;
  ~InterruptedFiles();
};

/// Returns what to print after an interrupt. `kept`: what to say of finished files.
[[nodiscard]] std::string interrupt_message(const std::string& kept);

}  // namespace relief::cli

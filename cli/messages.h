// Lines on standard error, and exit codes.
#pragma once

#include <string_view>

namespace relief::cli {

inline constexpr int kDone = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;

/// Wipes the line of a terminal.
inline constexpr const char* kWipeLine = "\r\x1b[K";

/// Returns whether a bar can be drawn there and drawn over: it is a terminal, and not one for which
/// TERM is `dumb` or missing (an editor's window, a log).
[[nodiscard]] bool shows_bars(int descriptor);

/// Prints "relief: " and `text` in one line on standard error.
void print_message(std::string_view text);

/// Prints a message after wiping a progress bar; for a process that is about to end, because it
/// waits for no lock.
void print_last_message(std::string_view text);

}  // namespace relief::cli

#include "cli/messages.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace relief::cli {

bool shows_bars(int descriptor) {
  const char* const terminal = std::getenv("TERM");
  return isatty(descriptor) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

void print_message(std::string_view text) {
  // Not fmt::print: it throws where standard error is closed or full.
  std::fputs(fmt::format("relief: {}\n", text).c_str(), stderr);
}

void print_last_message(std::string_view text) {
  const std::string line =
      fmt::format("{}relief: {}\n", shows_bars(STDERR_FILENO) ? kWipeLine : "", text);
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace relief::cli

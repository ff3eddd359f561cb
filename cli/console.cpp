#include "cli/console.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "common/io/standard_input.h"

namespace relief::cli {

void hold_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    if (::fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // It takes the lowest number, which is this one. The wrong way round, so that its use fails.
    [[maybe_unused]] const int opened =
        ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

int fail(const Error& error, std::string_view kept) {
  if (interrupted()) {
    print_message(interrupt_message(std::string(kept)));
  } else {
    print_message(fmt::format("{}{}{}", error.message, kept.empty() ? "" : "; ", kept));
  }
  return kFailed;
}

int print_result(std::string_view text) {
  errno = 0;
  const bool written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (written || errno == EPIPE) return kDone;
  if (errno == EBADF) return fail(Error{"standard output is closed; the result is not printed"});
  return fail(make_error("standard output: the result cannot be printed: {}",
                         std::generic_category().message(errno)));
}

int print_json(const nlohmann::ordered_json& result) {
  return print_result(result.dump(2) + "\n");
}

Status open_inputs(const std::vector<std::filesystem::path>& inputs) {
  if (std::ranges::find(inputs, kStandardName) == inputs.end()) return {};
  ConsoleProgress progress;
  return spool_standard_input(progress);
}

}  // namespace relief::cli

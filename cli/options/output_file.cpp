#include "cli/options/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <CLI/Error.hpp>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/console.h"
#include "common/io/standard_input.h"

namespace relief::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

/// Copies an open file to standard output.
Status copy_out(int file) {
  std::vector<char> piece(kPieceBytes);
  for (;;) {
    const ssize_t got = ::read(file, piece.data(), piece.size());
    if (got == 0) return {};
    if (got < 0) return Error{"standard output: what was written cannot be read back"};
    for (ssize_t done = 0; done < got;) {
      const ssize_t put =
          ::write(STDOUT_FILENO, piece.data() + done, static_cast<std::size_t>(got - done));
      if (put < 0 && errno == EINTR && !interrupted()) continue;
      if (put < 0)
        return make_error("standard output: can't be written: {}",
                          std::generic_category().message(errno));
      done += put;
    }
  }
}

}  // namespace

Result<OutputFile> OutputFile::open(const fs::path& named, std::string_view extension) {
  if (named != kStandardName) return OutputFile(named, std::nullopt);
  if (::isatty(STDOUT_FILENO) == 1)
    return Error{"standard output: is a terminal; redirect it to a file, or name a file with -o"};
  RELIEF_TRY_ASSIGN(auto folder, TemporaryFolder::make("relief"));
  fs::path path = folder.path() / ("output" + std::string(extension));
  return OutputFile(std::move(path), std::move(folder));
}

Status OutputFile::send() {
  const int file = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return Error{"standard output: what was written cannot be read back"};
  // Removed before it is copied: a reader that goes away may end this process.
  folder_.reset();
  Status sent = copy_out(file);
  ::close(file);
  return sent;
}

int OutputFile::finish(std::string_view report) {
  if (!folder_) return print_result(report);
  if (const Status sent = send(); !sent) return fail(sent.error());
  fmt::print(stderr, "{}", report);
  return kDone;
}

int OutputFile::finish_json(const nlohmann::ordered_json& report) {
  return finish(report.dump(2) + "\n");
}

void check_json(const fs::path& output, bool json) {
  if (json && output == kStandardName) {
    throw CLI::ValidationError("--json",
                               "prints on standard output, where --output - writes the file; name "
                               "a file to write");
  }
}

}  // namespace relief::cli

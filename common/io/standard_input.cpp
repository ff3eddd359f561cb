#include "common/io/standard_input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "common/io/waiting_read.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;

Error failure(std::string_view what, int error) {
  return make_error("standard input: {}: {}", what, std::generic_category().message(error));
}

/// Opens a new file that has no name any more; -1 and errno otherwise.
int open_nameless() {
  std::error_code ignored;
  std::string name = (fs::temp_directory_path(ignored) / "relief-XXXXXX").string();
  const int file = ::mkostemp(name.data(), O_CLOEXEC);
  if (file >= 0) ::unlink(name.c_str());
  return file;
}

Status copy_to(int file, Progress& progress) {
  progress.begin_stage("standard input", 0);
  std::vector<char> piece(kPieceBytes);
  for (;;) {
    const auto got = waiting_read(STDIN_FILENO, piece.data(), piece.size(), progress);
    if (!got) return interrupted_error();
    if (*got < 0) return failure("cannot be read", errno);
    if (*got == 0) return {};
    for (ssize_t done = 0; done < *got;) {
      const ssize_t put = ::write(file, piece.data() + done, static_cast<std::size_t>(*got - done));
      if (put < 0 && errno == EINTR) continue;
      if (put < 0) return failure("cannot be copied to the folder for temporary files", errno);
      done += put;
    }
  }
}

}  // namespace

fs::path input_path(const fs::path& path) {
  return path == kStandardName ? fs::path("/proc/self/fd/0") : path;
}

Status spool_standard_input(Progress& progress) {
  struct stat status {};
  if (::fstat(STDIN_FILENO, &status) != 0)
    return Error{"standard input: is closed; pipe a file into it"};
  if (S_ISREG(status.st_mode)) return {};
  if (::isatty(STDIN_FILENO) == 1)
    return Error{"standard input: is a terminal; pipe a file into it"};
  if (S_ISDIR(status.st_mode)) return Error{"standard input: is a directory, not a file"};
  const int file = open_nameless();
  if (file < 0) return failure("cannot be copied to the folder for temporary files", errno);
  Status copied = copy_to(file, progress);
  if (copied && ::dup2(file, STDIN_FILENO) < 0) copied = failure("cannot be replaced", errno);
  ::close(file);
  return copied;
}

}  // namespace relief

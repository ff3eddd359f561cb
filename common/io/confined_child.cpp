#include "common/io/confined_child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "common/io/waiting_read.h"

namespace relief {
namespace {

/// Limits the child and makes it end with its parent.
void confine(std::uint64_t memory) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::signal(SIGPIPE, SIG_DFL);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) ::signal(fault, SIG_DFL);
  const struct rlimit no_core { 0, 0 };
  ::setrlimit(RLIMIT_CORE, &no_core);
  unsigned long pages = 0;
  if (FILE* const size = std::fopen("/proc/self/statm", "r"); size != nullptr) {
    if (std::fscanf(size, "%lu", &pages) != 1) pages = 0;
    std::fclose(size);
  }
  if (pages == 0) return;
  const rlim_t most = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + memory;
  const struct rlimit limit { most, most };
  ::setrlimit(RLIMIT_AS, &limit);
}

/// What a library says of a file on the standard streams would stand between our own lines.
void silence() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
}

}  // namespace

bool ChildOutput::write(const void* bytes, std::size_t size) const {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t put = ::write(pipe_, at, size);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put;
    size -= static_cast<std::size_t>(put);
  }
  return true;
}

ConfinedChild::~ConfinedChild() {
  if (pipe_ >= 0) ::close(pipe_);
  if (child_ <= 0) return;
  ::kill(child_, SIGKILL);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

Status ConfinedChild::start(std::uint64_t memory,
                            const std::function<void(const ChildOutput&)>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return make_error("{}", std::strerror(errno));
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[0]);
    confine(memory);
    silence();
    try {
      work(ChildOutput(ends[1]));
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
  if (child_ < 0) return make_error("{}", std::strerror(errno));
  return {};
}

ConfinedChild::Got ConfinedChild::read(void* bytes, std::size_t size,
                                       const Progress& progress) const {
  for (char* at = static_cast<char*>(bytes); size > 0;) {
    const auto got = waiting_read(pipe_, at, size, progress);
    if (!got) return Got::Interrupted;
    if (*got <= 0) return Got::Ended;
    at += *got;
    size -= static_cast<std::size_t>(*got);
  }
  return Got::All;
}

}  // namespace relief

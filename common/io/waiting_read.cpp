#include "common/io/waiting_read.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>

namespace relief {

std::optional<ssize_t> waiting_read(int file, void* bytes, std::size_t size,
                                    const Progress& progress) {
  constexpr int kStepMilliseconds = 100;
  while (!progress.cancelled()) {
    struct pollfd wait {
      file, POLLIN, 0
    };
    const int ready = ::poll(&wait, 1, kStepMilliseconds);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t got = ::read(file, bytes, size);
    if (got >= 0 || errno != EINTR) return got;
  }
  return std::nullopt;
}

}  // namespace relief

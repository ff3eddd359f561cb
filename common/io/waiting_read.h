// Reads of pipes that can be interrupted.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>

#include "common/progress.h"

namespace relief {

/// As ::read(), but waits in steps of 0.1 s for what is not there yet, so that an interrupt is seen
/// while the other program writes nothing: then none.
[[nodiscard]] std::optional<ssize_t> waiting_read(int file, void* bytes, std::size_t size,
                                                  const Progress& progress);

}  // namespace relief

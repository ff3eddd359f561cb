// Limits the number of threads.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace relief {

/// Calls `work` with at most this many threads (0: all cores) and returns its result.
template <class Work>
auto with_threads(int threads, const Work& work) {
  if (threads <= 0) threads = tbb::this_task_arena::max_concurrency();
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace relief

// Work on no more threads than the user allows.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace relief {

/// Calls `work` where at most so many threads run (0: all cores) and gives what it returns.
template <class Work>
auto with_threads(int threads, const Work& work) {
  if (threads <= 0) threads = tbb::this_task_arena::max_concurrency();
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(work);
}

}  // namespace relief

// Rows of a bench whose engines draw on the CPU.
#pragma once

#include <span>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/bench/bench_row.h"

namespace relief::bench_passes {

/// Draws every row once, which is not timed, then in turns in as many rounds as kCpuSeconds and
/// kMostCpuFrames allow, at most `frames`. Times are those of the engines: of the drawing, not of
/// making the model ready. There are no bytes on a GPU. Fails as render() does.
Result<std::vector<BenchRow>> time_on_cpu(std::span<const BenchMethod> rows, int frames,
                                          Progress& progress);

}  // namespace relief::bench_passes

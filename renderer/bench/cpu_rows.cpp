#include "renderer/bench/cpu_rows.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>

#include "common/median.h"
#include "renderer/engine_registry.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief::bench_passes {
namespace {

/// A row while it is timed.
struct CpuRow {
  const BenchMethod& method;
  std::unique_ptr<PreparedModel> prepared;
  std::vector<double> frame_ms = {};
};

/// Timed rounds, for rows whose slowest frame took so long.
int rounds_for(double slowest_ms, int frames) {
  const int most = std::min(frames, kMostCpuFrames);
  if (slowest_ms * most <= 1e3 * kCpuSeconds) return most;
  return std::max(1, static_cast<int>(1e3 * kCpuSeconds / slowest_ms));
}

/// A frame of a row, in milliseconds, and what it counts.
Result<BenchRow> draw(const CpuRow& row, const Progress& progress) {
  QuietProgress quiet(progress);
  RELIEF_TRY_ASSIGN(const auto drawn, row.prepared->render(row.method.settings, quiet));
  if (progress.cancelled()) return interrupted_error();
  BenchRow result;
  result.time = {1, drawn.frame_ms, std::nullopt};
  result.covered_pixels = drawn.covered_pixels;
  result.fragments = drawn.fragments;
  return result;
}

}  // namespace

Result<std::vector<BenchRow>> time_on_cpu(std::span<const BenchMethod> rows, int frames,
                                          Progress& progress) {
  const auto environments = std::make_shared<EnvironmentCache>();
  std::vector<CpuRow> timed;
  std::vector<BenchRow> results;
  double slowest_ms = 0.0;
  progress.begin_stage("first frames on the CPU", rows.size());
  for (const BenchMethod& row : rows) {
    if (progress.cancelled()) return interrupted_error();
    const EngineEntry* const engine = find_engine(row.settings.engine);
    assert(engine != nullptr && !engine->capabilities.needs_opengl && "a row on the CPU");
    RELIEF_TRY_ASSIGN(auto prepared, engine->prepare({.model = row.model,
                                                      .views = {&row.settings, 1},
                                                      .opengl = nullptr,
                                                      .environments = environments}));
    timed.push_back({row, std::move(prepared)});
    RELIEF_TRY_ASSIGN(const auto first, draw(timed.back(), progress));
    results.push_back(first);
    slowest_ms = std::max(slowest_ms, first.time.frame_ms);
    progress.advance(1);
  }
  const int rounds = rounds_for(slowest_ms, frames);
  progress.begin_stage("frames on the CPU", static_cast<std::uint64_t>(rounds) * rows.size());
  for (int round = 0; round < rounds; ++round) {
    for (CpuRow& row : timed) {
      RELIEF_TRY_ASSIGN(const auto drawn, draw(row, progress));
      row.frame_ms.push_back(drawn.time.frame_ms);
      progress.advance(1);
    }
  }
  for (std::size_t k = 0; k < timed.size(); ++k)
    results[k].time = {rounds, median_of(std::move(timed[k].frame_ms)), std::nullopt};
  return results;
}

}  // namespace relief::bench_passes

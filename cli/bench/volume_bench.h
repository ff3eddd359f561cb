// `relief bench` of volumes and 3D Gaussians, alone or among surfaces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/bench/bench_rows.h"
#include "common/error.h"
#include "common/progress.h"
#include "loader/scene/loaded_scene.h"

namespace relief::cli {

struct VolumeBenchRow {
  RenderSettings settings;
  bool is_default = false;  ///< what `relief render` draws
  double frame_ms = 0.0;    ///< median
  std::optional<double> gpu_ms;
  std::uint64_t covered_pixels = 0;
  std::optional<std::uint64_t> fragments;  ///< evaluations of footprints
  std::optional<double> psnr_db;           ///< against the truth; none of the truth itself
  std::optional<double> flip_mean;
};

struct VolumeBench {
  std::string renderer;  ///< OpenGL's own name
  std::string truth;     ///< the engine that the rows are compared with
  int frames = 0;
  int warm_up = 1;
  std::vector<VolumeBenchRow> rows;
};

/// Draws the view by each engine that draws volumes among surfaces: frame k of each before frame
/// k + 1 of any. Compares the images with those of `volume-truth` if it draws the scene, else of
/// `volume-reference`. Fails as render_views() does.
Result<VolumeBench> bench_volumes(const LoadedScene& scene, const BenchView& view, int frames,
                                  Progress& progress);

}  // namespace relief::cli

#include "cli/plot/bench_plot.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

namespace relief::cli {
namespace {

PlotPanel panel_of(const BenchResult& result, const std::string& title,
                   std::optional<double> RowAccuracy::*quality) {
  PlotPanel panel{title, "PSNR, dB", {}};
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const std::optional<double> psnr_db = result.accuracy[k].*quality;
    if (!psnr_db || !std::isfinite(*psnr_db)) continue;
    panel.points.push_back({name_of_row(result, k), result.times.rows[k].time.frame_ms, *psnr_db,
                            is_default_row(result, k)});
  }
  return panel;
}

}  // namespace

Plot plot_of(const BenchResult& result) {
  const RenderSettings& first = result.rows.front();
  const std::string material(name_of(kMaterials, first.material));
  Plot plot;
  plot.title =
      fmt::format("{}, {}x{}, {}", result.scene, first.width, first.height, result.times.renderer);
  plot.cost_label = fmt::format("ms a frame, {}", material);
  if (result.times.shading_bound)
    plot.lines.push_back({"shading bound", result.times.shading_bound->time.frame_ms});
  if (result.times.mesh) plot.lines.push_back({"input mesh", result.times.mesh->time.frame_ms});
  if (result.compares_engines) {
    plot.panels.push_back(
        panel_of(result, material + ", pixels that both cover", &RowAccuracy::psnr_covered_db));
    plot.panels.push_back(panel_of(result, material + ", all pixels", &RowAccuracy::psnr_db));
    return plot;
  }
  plot.panels.push_back(panel_of(result, material, &RowAccuracy::psnr_db));
  if (first.material != Material::Mirror)
    plot.panels.push_back(panel_of(result, "as a mirror", &RowAccuracy::psnr_mirror_db));
  return plot;
}

}  // namespace relief::cli

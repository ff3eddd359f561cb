#include "cli/reports/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/bench/bench_rows.h"
#include "cli/reports/json_values.h"
#include "cli/reports/option_values.h"

namespace relief::cli {
namespace {

std::string level_policy(const RenderSettings& settings) {
  const double pixels = pixels_per_sample_of(settings);
  return pixels > 0.0 ? fmt::format("at most {:g} pixels a sample", pixels) : std::string("finest");
}

using Json = nlohmann::ordered_json;

std::optional<double> ratio(double value, std::optional<double> over) {
  if (!over || *over <= 0.0) return std::nullopt;
  return value / *over;
}

std::optional<double> frame_ms_of(const std::optional<BenchRow>& row) {
  return row ? std::optional<double>(row->time.frame_ms) : std::nullopt;
}

std::optional<double> gpu_ms_of(const std::optional<BenchRow>& row) {
  return row ? row->time.gpu_ms : std::nullopt;
}

/// The fastest row of the rival with its default radius factor.
std::optional<double> rival_ms(const BenchResult& result) {
  std::optional<double> best;
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const RenderSettings& row = result.rows[k];
    if (row.engine != kRivalEngine || !has_default_numbers(row)) continue;
    const double ms = result.times.rows[k].time.frame_ms;
    best = std::min(best.value_or(ms), ms);
  }
  return best;
}

/// A row relative to the others.
struct Ratios {
  std::optional<double> overdraw;
  std::optional<double> to_multipass;
  std::optional<double> to_bound;
  std::optional<double> to_mesh;
};

Ratios ratios_of(const BenchResult& result, const BenchRow& row) {
  const double ms = row.time.frame_ms;
  return {ratio(static_cast<double>(row.fragments), static_cast<double>(row.covered_pixels)),
          ratio(ms, rival_ms(result)), ratio(ms, frame_ms_of(result.times.shading_bound)),
          ratio(ms, frame_ms_of(result.times.mesh))};
}

Json row_as_json(const BenchResult& result, std::size_t k) {
  const RenderSettings& settings = result.rows[k];
  const BenchRow& row = result.times.rows[k];
  const RowAccuracy& accuracy = result.accuracy[k];
  const Ratios ratios = ratios_of(result, row);
  Json json = {{"engine", settings.engine}};
  json.update(options_as_json(settings));
  json.erase("samples");  // those of a pixel; below are the model's
  json.update({{"level_policy", level_policy(settings)},
               {"sweep_value", value_or_null(result.swept_values[k])},
               {"samples", result.samples[k]},
               {"default", is_default_row(result, k)},
               {"frame_ms", row.time.frame_ms},
               {"gpu_ms", value_or_null(row.time.gpu_ms)},
               {"ratio_to_multipass", value_or_null(ratios.to_multipass)},
               {"ratio_to_shading_bound", value_or_null(ratios.to_bound)},
               {"ratio_to_mesh", value_or_null(ratios.to_mesh)},
               {"covered_pixels", row.covered_pixels},
               {"fragments", row.fragments},
               {"overdraw", value_or_null(ratios.overdraw)},
               {"gpu_bytes", row.gpu_bytes},
               {"model_bytes", row.model_bytes},
               {"psnr_db", finite_or_null(accuracy.psnr_db)},
               {"psnr_covered_db", finite_or_null(accuracy.psnr_covered_db)},
               {"psnr_mirror_db", finite_or_null(accuracy.psnr_mirror_db)},
               {"psnr_mirror_covered_db", finite_or_null(accuracy.psnr_mirror_covered_db)},
               {"flip_mean", finite_or_null(accuracy.flip_mean)},
               {"holes", value_or_null(accuracy.holes)}});
  return json;
}

std::string number(const std::optional<double>& value, int digits) {
  if (!value) return "-";
  return std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "same";
}

std::size_t name_width(const BenchResult& result) {
  std::size_t width = 0;
  for (std::size_t k = 0; k < result.rows.size(); ++k)
    width = std::max(width, name_of_row(result, k).size());
  return width;
}

std::string row_as_text(const BenchResult& result, std::size_t k) {
  const BenchRow& row = result.times.rows[k];
  const RowAccuracy& accuracy = result.accuracy[k];
  const Ratios ratios = ratios_of(result, row);
  return fmt::format("{} {:<{}} {:>9} {:>11} {:>7} {:>7} {:>9} {:>9.1f} {:>8} {:>8} {:>8} {:>6}\n",
                     is_default_row(result, k) ? '*' : ' ', name_of_row(result, k),
                     name_width(result), number(row.time.frame_ms, 2),
                     number(ratios.to_multipass, 3), number(ratios.to_bound, 2),
                     number(ratios.to_mesh, 2), number(ratios.overdraw, 2),
                     1e-6 * static_cast<double>(row.model_bytes), number(accuracy.psnr_db, 2),
                     number(accuracy.psnr_mirror_db, 2), number(accuracy.flip_mean, 4),
                     accuracy.holes ? fmt::format("{}", *accuracy.holes) : std::string("-"));
}

}  // namespace

std::string name_of_row(const BenchResult& result, std::size_t row) {
  std::string name = name_of_row(result.rows[row]);
  if (result.swept_values[row])
    name += fmt::format(", {} {:g}", result.swept, *result.swept_values[row]);
  return name;
}

bool is_default_row(const BenchResult& result, std::size_t row) {
  return !result.swept_values[row] && is_default(result.rows[row]);
}

Json as_json(const BenchResult& result) {
  const RenderSettings& first = result.rows.front();
  Json rows = Json::array();
  for (std::size_t k = 0; k < result.rows.size(); ++k) rows.push_back(row_as_json(result, k));
  const auto& mesh = result.times.mesh;
  return {{"renderer", result.times.renderer},
          {"width", first.width},
          {"height", first.height},
          {"material", name_of(kMaterials, first.material)},
          {"frames", result.frames},
          {"warm_up", result.warm_up},
          {"sweep", result.swept.empty() ? Json(nullptr) : Json(result.swept)},
          {"samples", result.samples[result.reference]},
          {"covered_pixels", result.times.rows[result.reference].covered_pixels},
          {"shading_bound_ms", value_or_null(frame_ms_of(result.times.shading_bound))},
          {"shading_bound_gpu_ms", value_or_null(gpu_ms_of(result.times.shading_bound))},
          {"mesh_ms", value_or_null(frame_ms_of(mesh))},
          {"mesh_gpu_ms", value_or_null(gpu_ms_of(mesh))},
          {"mesh_triangles", value_or_null(result.mesh_triangles)},
          {"mesh_bytes", mesh ? Json(mesh->model_bytes) : Json(nullptr)},
          {"rows", std::move(rows)}};
}

std::string as_text(const BenchResult& result) {
  const RenderSettings& first = result.rows.front();
  const auto& mesh = result.times.mesh;
  std::string text = fmt::format(
      "{}{}\n"
      "  renderer        {}\n"
      "  image           {}x{}, {}, {} pixels covered\n"
      "  frames          {} a row in turns, after {}; medians\n"
      "  samples         {}\n"
      "  shading bound   {} ms\n"
      "  input mesh      {}\n\n",
      result.scene, result.view.empty() ? "" : ", view " + result.view, result.times.renderer,
      first.width, first.height, name_of(kMaterials, first.material),
      result.times.rows[result.reference].covered_pixels, result.frames, result.warm_up,
      result.samples[result.reference], number(frame_ms_of(result.times.shading_bound), 2),
      mesh ? fmt::format("{:.2f} ms, {} triangles, {:.1f} MB", mesh->time.frame_ms,
                         *result.mesh_triangles, 1e-6 * static_cast<double>(mesh->model_bytes))
           : std::string("none: the scene has no faces"));
  text += fmt::format("  {:<{}} {:>9} {:>11} {:>7} {:>7} {:>9} {:>9} {:>8} {:>8} {:>8} {:>6}\n", "",
                      name_width(result), "frame ms", "/multipass", "/bound", "/mesh", "overdraw",
                      "model MB", "PSNR", "mirror", "FLIP", "holes");
  for (std::size_t k = 0; k < result.rows.size(); ++k) text += row_as_text(result, k);
  text += "* what `relief render` draws by default\n";
  return text;
}

}  // namespace relief::cli

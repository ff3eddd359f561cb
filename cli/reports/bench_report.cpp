#include "cli/reports/bench_report.h"

#include <fmt/format.h>

#include <algorithm>
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
    const bool is_rival = row.engine == kRivalEngine && row.clip.rule == ClipRule::Off;
    if (!is_rival || !has_default_numbers(row)) continue;
    const double ms = result.times.rows[k].time.frame_ms;
    best = std::min(best.value_or(ms), ms);
  }
  return best;
}

/// What is reported only where engines are compared.
Json engine_keys(const BenchResult& result, std::size_t k) {
  const RowAccuracy& accuracy = result.accuracy[k];
  return {{"name", name_of_row(result, k)},
          {"input", result.inputs[k] == BenchInput::Points ? "points" : "samples"},
          {"frames", result.times.rows[k].time.frames},
          {"border_missing", value_or_null(accuracy.border_missing)},
          {"border_extra", value_or_null(accuracy.border_extra)},
          {"normal_rms_deg", finite_or_null(accuracy.normal_rms_deg)}};
}

Json row_as_json(const BenchResult& result, std::size_t k) {
  const RenderSettings& settings = result.rows[k];
  const BenchRow& row = result.times.rows[k];
  const RowAccuracy& accuracy = result.accuracy[k];
  const BenchRatios ratios = ratios_of(result, row);
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
               {"fragments", value_or_null(row.fragments)},
               {"overdraw", value_or_null(ratios.overdraw)},
               {"gpu_bytes", value_or_null(row.gpu_bytes)},
               {"model_bytes", value_or_null(row.model_bytes)},
               {"psnr_db", finite_or_null(accuracy.psnr_db)},
               {"psnr_covered_db", finite_or_null(accuracy.psnr_covered_db)},
               {"psnr_mirror_db", finite_or_null(accuracy.psnr_mirror_db)},
               {"psnr_mirror_covered_db", finite_or_null(accuracy.psnr_mirror_covered_db)},
               {"flip_mean", finite_or_null(accuracy.flip_mean)},
               {"holes", value_or_null(accuracy.holes)}});
  if (result.compares_engines) json.update(engine_keys(result, k));
  return json;
}

}  // namespace

std::string name_of_row(const BenchResult& result, std::size_t row) {
  if (result.compares_engines) return short_name_of_row(result.rows[row]);
  std::string name = name_of_row(result.rows[row]);
  if (result.swept_values[row])
    name += fmt::format(", {} {:g}", result.swept, *result.swept_values[row]);
  return name;
}

bool is_default_row(const BenchResult& result, std::size_t row) {
  return !result.swept_values[row] && is_default(result.rows[row]);
}

BenchRatios ratios_of(const BenchResult& result, const BenchRow& row) {
  const double ms = row.time.frame_ms;
  const auto fragments =
      row.fragments ? std::optional(static_cast<double>(*row.fragments)) : std::nullopt;
  return {fragments ? ratio(*fragments, static_cast<double>(row.covered_pixels)) : std::nullopt,
          ratio(ms, rival_ms(result)), ratio(ms, frame_ms_of(result.times.shading_bound)),
          ratio(ms, frame_ms_of(result.times.mesh))};
}

Json as_json(const BenchResult& result) {
  const RenderSettings& first = result.rows.front();
  Json rows = Json::array();
  for (std::size_t k = 0; k < result.rows.size(); ++k) rows.push_back(row_as_json(result, k));
  const auto& mesh = result.times.mesh;
  Json json = {{"renderer", result.times.renderer},
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
               {"mesh_bytes", mesh ? value_or_null(mesh->model_bytes) : Json(nullptr)}};
  if (result.compares_engines) json["truth"] = result.truth_is_input ? "faces" : "patches";
  json["rows"] = std::move(rows);
  return json;
}

}  // namespace relief::cli

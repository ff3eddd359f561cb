#include "cli/reports/volume_bench_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/reports/json_values.h"
#include "cli/reports/option_values.h"

namespace relief::cli {
namespace {

using Json = nlohmann::ordered_json;

Json row_as_json(const VolumeBenchRow& row) {
  Json json = {{"engine", row.settings.engine}};
  json.update(options_as_json(row.settings));
  json.update({{"default", row.is_default},
               {"frame_ms", row.frame_ms},
               {"gpu_ms", value_or_null(row.gpu_ms)},
               {"covered_pixels", row.covered_pixels},
               {"fragments", value_or_null(row.fragments)},
               {"psnr_db", finite_or_null(row.psnr_db)},
               {"flip_mean", finite_or_null(row.flip_mean)}});
  return json;
}

std::string table_number(const std::optional<double>& value, int digits) {
  if (!value) return "-";
  return std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "same";
}

}  // namespace

Json as_json(const VolumeBench& result) {
  const VolumeBenchRow& first = result.rows.front();
  Json rows = Json::array();
  for (const VolumeBenchRow& row : result.rows) rows.push_back(row_as_json(row));
  return {
      {"renderer", result.renderer},     {"width", first.settings.width},
      {"height", first.settings.height}, {"material", name_of(kMaterials, first.settings.material)},
      {"truth", result.truth},           {"frames", result.frames},
      {"warm_up", result.warm_up},       {"covered_pixels", first.covered_pixels},
      {"shading_bound_ms", nullptr},     {"mesh_ms", nullptr},
      {"rows", std::move(rows)}};
}

std::string as_text(const VolumeBench& result, const std::string& scene) {
  const VolumeBenchRow& first = result.rows.front();
  std::string text = fmt::format(
      "{}\n"
      "  renderer        {}\n"
      "  image           {}x{}, {} pixels covered\n"
      "  frames          {} a row in turns, after {}; medians\n"
      "  truth           {}\n\n"
      "  {:<18} {:>9} {:>8} {:>8}\n",
      scene, result.renderer, first.settings.width, first.settings.height, first.covered_pixels,
      result.frames, result.warm_up, result.truth, "", "frame ms", "PSNR", "FLIP");
  for (const VolumeBenchRow& row : result.rows) {
    text += fmt::format("{} {:<18} {:>9.2f} {:>8} {:>8}\n", row.is_default ? '*' : ' ',
                        row.settings.engine, row.frame_ms, table_number(row.psnr_db, 2),
                        table_number(row.flip_mean, 4));
  }
  text += "* what `relief render` draws by default\n";
  return text;
}

}  // namespace relief::cli

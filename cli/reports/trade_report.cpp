#include "cli/reports/trade_report.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/reports/json_values.h"
#include "cli/trade/trade_front.h"
#include "cli/trade/trade_plot.h"

namespace relief::cli {
namespace {

nlohmann::ordered_json row_as_json(const TradeReport& report, std::size_t k) {
  const TradeRow& row = report.rows[k];
  nlohmann::ordered_json out{{"name", row.name}};
  out["quality"] = row.quality ? nlohmann::ordered_json(relief::name_of(kQualities, *row.quality))
                               : nlohmann::ordered_json(nullptr);
  out["default"] = k == 0;
  out["convert"] = convert_command(report.knobs, row.setting);
  out["render"] = render_command(report.knobs, row.setting);
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (std::size_t knob = 0; knob < report.knobs.size(); ++knob)
    settings[report.knobs[knob].name] = report.knobs[knob].choices[row.setting[knob]].label;
  out["settings"] = std::move(settings);
  out["convert_seconds"] = row.file.convert_seconds;
  out["load_seconds"] = row.file.load_seconds;
  out["file_bytes"] = row.file.file_bytes;
  out["surface_psnr_db"] = finite_or_null(row.file.surface_psnr_db);
  out["samples"] = row.file.samples;
  out["patches"] = row.file.patches;
  out["frame_ms"] = row.frame_ms;
  out["frames"] = row.frames;
  out["gpu_bytes"] = value_or_null(row.gpu_bytes);
  out["psnr_db"] = finite_or_null(row.accuracy.psnr_db);
  out["flip_mean"] = value_or_null(row.accuracy.flip_mean);
  out["normal_rms_deg"] = finite_or_null(row.accuracy.normal_rms_deg);
  out["holes"] = value_or_null(row.accuracy.holes);
  out["border_missing"] = value_or_null(row.accuracy.border_missing);
  out["border_extra"] = value_or_null(row.accuracy.border_extra);
  nlohmann::ordered_json distances = nlohmann::ordered_json::object();
  for (const TradePlane& plane : trade_planes())
    distances[plane.key] = value_or_null(distance_to_front(report.rows, k, plane));
  distances["judged"] = value_or_null(distance_to_front(report.rows, k, judged_quantities()));
  out["distance_to_front"] = std::move(distances);
  return out;
}

std::string percent_behind(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100.0 * *share) : std::string("-");
}

std::string row_as_text(const TradeReport& report, std::size_t k) {
  return fmt::format("  {}\n    {}\n", report.rows[k].name, describe_row(report.rows[k]));
}

}  // namespace

nlohmann::ordered_json as_json(const TradeReport& report) {
  nlohmann::ordered_json out{{"scene", report.scan},
                             {"points", report.points},
                             {"width", report.width},
                             {"height", report.height},
                             {"material", relief::name_of(kMaterials, report.material)},
                             {"renderer", report.renderer}};
  constexpr std::array<const char*, 3> kTruths{"file", "faces", "finest patches"};
  out["truth"] = kTruths[static_cast<std::size_t>(report.truth_is)];
  out["truth_file"] =
      report.truth.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(report.truth);
  out["truth_triangles"] = report.truth_triangles;
  out["seconds"] = report.seconds;
  out["single_changes"] = report.single_changes;
  out["tried_single_changes"] = report.tried_single_changes;
  out["complete"] = report.is_complete;
  nlohmann::ordered_json answers = nlohmann::ordered_json::array();
  for (const TradeAnswer& found : report.answers) {
    nlohmann::ordered_json entry{{"question", found.question.text}};
    entry["row"] = value_or_null(found.row);
    entry["why_not"] =
        found.row ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(found.why_not);
    answers.push_back(std::move(entry));
  }
  out["answers"] = std::move(answers);
  nlohmann::ordered_json fronts = nlohmann::ordered_json::array();
  for (const TradePlane& plane : trade_planes()) {
    fronts.push_back({{"front", plane.key},
                      {"cost", plane.cost.key},
                      {"quality", plane.quality.key},
                      {"rows", front_of(report.rows, plane)}});
  }
  out["fronts"] = std::move(fronts);
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < report.rows.size(); ++k) rows.push_back(row_as_json(report, k));
  out["rows"] = std::move(rows);
  return out;
}

std::string describe_truth(const TradeReport& report) {
  const std::string count = fmt::format("{} triangles", report.truth_triangles);
  switch (report.truth_is) {
    case TradeTruth::File:
      return fmt::format("{}, {}", report.truth, count);
    case TradeTruth::Faces:
      return fmt::format("the input's own faces, {}", count);
    case TradeTruth::FinestPatches:
      break;
  }
  return fmt::format("the input has no faces: patches of 4 samples a point, {}", count);
}

std::string describe_row(const TradeRow& row) {
  std::string line = readable(frame_time(), row.frame_ms) + " a frame";
  if (const auto psnr_db = picture_psnr().of(row))
    line += ", picture " + readable(picture_psnr(), *psnr_db);
  if (const auto psnr_db = surface_psnr().of(row))
    line += ", surface " + readable(surface_psnr(), *psnr_db);
  line += ", " + readable(file_size(), static_cast<double>(row.file.file_bytes)) + " on disk";
  if (row.gpu_bytes)
    line += ", " + readable(gpu_size(), static_cast<double>(*row.gpu_bytes)) + " on the GPU";
  return line + ", " + readable(conversion_time(), row.file.convert_seconds) + " to convert";
}

std::string as_text(const TradeReport& report, const std::string& page) {
  std::string text =
      fmt::format("{}, {}x{}, {}, {}\n  truth     {}\n  settings  {} in {:.0f} s{}\n", report.scan,
                  report.width, report.height, relief::name_of(kMaterials, report.material),
                  report.renderer, describe_truth(report), report.rows.size(), report.seconds,
                  report.is_complete ? ", all neighbours of the fronts among them"
                                     : "; a longer --trade-seconds may find more");
  text += "\nanswers\n";
  for (const TradeAnswer& found : report.answers) {
    text += fmt::format("{}\n", found.question.text);
    text +=
        found.row ? row_as_text(report, *found.row) : fmt::format("  none: {}\n", found.why_not);
  }
  text +=
      "\npresets, and how far they are from the front of frame time, bytes on disk and picture\n";
  const auto& planes = trade_planes();
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    if (!report.rows[k].quality) continue;
    text += fmt::format("{}: {}\n", relief::name_of(kQualities, *report.rows[k].quality),
                        percent_behind(distance_to_front(report.rows, k, judged_quantities())));
    text += row_as_text(report, k);
  }
  text += "\nfront of picture and frame time\n";
  for (const std::size_t k : front_of(report.rows, planes[0])) text += row_as_text(report, k);
  return text + fmt::format("\nall settings and plots: {}\n", page);
}

}  // namespace relief::cli

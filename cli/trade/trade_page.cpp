#include "cli/trade/trade_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "cli/plot/markup.h"
#include "cli/reports/trade_report.h"
#include "cli/trade/trade_front.h"
#include "cli/trade/trade_plot.h"

namespace relief::cli {
namespace {

/// JSON that a page can hold: no "<" in it, so that no text ends the element.
std::string json_for_page(const TradeReport& report) {
  std::string out;
  for (const char c :
       as_json(report).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

std::string introduction(const TradeReport& report) {
  return fmt::format(
      "<h1>The trade of {}</h1>\n"
      "<p>{} points, drawn at {}x{}, {}, by {}. Truth: {}, ray traced with 16 rays a pixel. {} "
      "settings were measured in {:.0f} s{}. A setting's time is its ratio to the default's, drawn "
      "in turns with it, times the default's median.</p>\n",
      as_markup(report.scan), report.points, report.width, report.height,
      relief::name_of(kMaterials, report.material), as_markup(report.renderer),
      as_markup(describe_truth(report)), report.rows.size(), report.seconds,
      report.is_complete ? ", all neighbours of the fronts among them"
                         : "; a longer <code>--trade-seconds</code> may find more");
}

std::string commands_of(const TradeReport& report, std::size_t k) {
  const TradeSetting& setting = report.rows[k].setting;
  return fmt::format("<code>{}</code><br><code>{}</code>",
                     as_markup(convert_command(report.knobs, setting)),
                     as_markup(render_command(report.knobs, setting)));
}

std::string answers_section(const TradeReport& report) {
  std::string html = "<h2>Answers</h2>\n";
  for (const TradeAnswer& found : report.answers) {
    html += fmt::format("<p><b>{}:</b> ", as_markup(found.question.text));
    if (found.row) {
      const TradeRow& row = report.rows[*found.row];
      html += fmt::format("{}. {}<br>{}</p>\n", as_markup(row.name), describe_row(row),
                          commands_of(report, *found.row));
    } else {
      html += fmt::format("none. {}</p>\n", as_markup(found.why_not));
    }
  }
  return html;
}

std::string distance_cell(const std::optional<double>& distance) {
  return distance ? fmt::format("<td>{:.1f} %</td>", 100.0 * *distance) : "<td>-</td>";
}

std::string presets_section(const TradeReport& report) {
  std::string html =
      "<h2>Presets</h2>\n<p>How far each <code>--quality</code> is from the fronts: with 5 % less "
      "of "
      "the cost, or 5 % less error, it would be on it. The first front is that of frame time, "
      "bytes "
      "on disk and picture at once.</p>\n<table><tr><th>preset</th><th>all three</th>";
  for (const TradePlane& plane : trade_planes()) html += fmt::format("<th>{}</th>", plane.title);
  html += "</tr>\n";
  for (std::size_t k = 0; k < report.rows.size(); ++k) {
    const TradeRow& row = report.rows[k];
    if (!row.quality) continue;
    html += fmt::format("<tr data-row=\"{}\"><td><b>{}</b>: {}<br>{}</td>", k,
                        relief::name_of(kQualities, *row.quality), as_markup(row.name),
                        describe_row(row));
    html += distance_cell(distance_to_front(report.rows, k, judged_quantities()));
    for (const TradePlane& plane : trade_planes())
      html += distance_cell(distance_to_front(report.rows, k, plane));
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string plots_section(const TradeReport& report) {
  std::string html =
      "<h2>Plots</h2>\n<p>Better is to the upper left. The line is the Pareto front. Rings are the "
      "presets; <i>balanced</i> is the default. The mouse shows a point's values, and where it is "
      "in the other plots.</p>\n<p class=\"key\">";
  const std::vector<std::string> painters = painters_of(report.knobs, report.rows);
  for (std::size_t n = 0; n < painters.size(); ++n) {
    html += fmt::format("<span><i class=\"dot\" style=\"background: {}\"></i>{}</span>",
                        colour_of_painter(n), painters[n]);
  }
  html += "</p>\n<div class=\"plots\">\n";
  for (const TradePlane& plane : trade_planes())
    html += trade_plot(report.knobs, report.rows, plane);
  return html + "</div>\n";
}

/// A cell with the number that it is sorted by.
std::string cell_of(std::optional<double> value, const std::string& text) {
  return value ? fmt::format("<td data-value=\"{:.9g}\">{}</td>", *value, text) : "<td>-</td>";
}

std::string cell_of(const std::optional<std::uint64_t>& count) {
  return count ? cell_of(static_cast<double>(*count), std::to_string(*count)) : "<td>-</td>";
}

std::string table_row(const TradeReport& report, std::size_t k, bool is_minor) {
  const TradeRow& row = report.rows[k];
  std::string html =
      fmt::format("<tr data-row=\"{}\"{}><td>{}{}</td>", k, is_minor ? " class=\"minor\"" : "",
                  as_markup(row.name),
                  row.quality ? fmt::format(" <b>{}</b>", relief::name_of(kQualities, *row.quality))
                              : std::string());
  const std::array<const TradeQuantity*, 7> quantities{
      &frame_time(), &picture_psnr(), &normal_error(),   &surface_psnr(),
      &file_size(),  &gpu_size(),     &conversion_time()};
  for (const TradeQuantity* const quantity : quantities) {
    const auto value = quantity->of(row);
    html += cell_of(value, value ? readable(*quantity, *value) : std::string());
  }
  const PictureAccuracy& accuracy = row.accuracy;
  html += cell_of(accuracy.flip_mean,
                  accuracy.flip_mean ? fmt::format("{:.4f}", *accuracy.flip_mean) : std::string());
  html += cell_of(accuracy.holes) + cell_of(accuracy.border_missing) +
          cell_of(accuracy.border_extra) + cell_of(row.file.samples);
  return html + "</tr>\n";
}

std::string table_section(const TradeReport& report) {
  std::vector<bool> is_minor(report.rows.size(), true);
  for (const TradePlane& plane : trade_planes()) {
    for (const std::size_t k : front_of(report.rows, plane)) is_minor[k] = false;
  }
  std::string html =
      "<h2>Settings</h2>\n<p>Those on some front, and the presets. <label><input type=\"checkbox\" "
      "id=\"full\"> Show all</label>. A click on a heading sorts.</p>\n<table "
      "id=\"all\"><thead><tr><th>differs from the default in</th><th>frame</th><th>picture</th>"
      "<th>normals</th><th>surface</th><th>on disk</th><th>on the "
      "GPU</th><th>conversion</th><th>FLIP</th><th>holes</th><th>missing</th><th>overhang</th>"
      "<th>samples</th></tr></thead><tbody>\n";
  for (std::size_t k = 0; k < report.rows.size(); ++k)
    html += table_row(report, k, is_minor[k] && !report.rows[k].quality);
  return html + "</tbody></table>\n";
}

}  // namespace

std::string trade_page(const TradeReport& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>The trade of "
      "{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n",
      as_markup(report.scan), trade_page_style(), trade_plot_style());
  html += introduction(report) + answers_section(report) + presets_section(report) +
          plots_section(report) + table_section(report);
  html += fmt::format(
      "<div id=\"tip\"></div>\n<script type=\"application/json\" "
      "id=\"report\">{}</script>\n<script>\n{}</script>\n</body>\n</html>\n",
      json_for_page(report), trade_page_script());
  return html;
}

}  // namespace relief::cli

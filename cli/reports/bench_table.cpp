// The report of `relief bench` as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "cli/bench/bench_rows.h"
#include "cli/reports/bench_report.h"

namespace relief::cli {
namespace {

std::string number(const std::optional<double>& value, int digits) {
  if (!value) return "-";
  return std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "same";
}

std::string count(const std::optional<std::uint64_t>& value) {
  return value ? fmt::format("{}", *value) : std::string("-");
}

std::string megabytes(const std::optional<std::uint64_t>& bytes) {
  return bytes ? fmt::format("{:.1f}", 1e-6 * static_cast<double>(*bytes)) : std::string("-");
}

/// What a cell is made of.
struct Row {
  BenchInput input;
  const BenchRow& drawn;
  const RowAccuracy& accuracy;
  BenchRatios ratios;
};

struct Column {
  const char* heading;
  int width;
  std::string (*cell)(const Row& row);
};

constexpr Column kFrameMs{"frame ms", 9,
                          [](const Row& r) { return number(r.drawn.time.frame_ms, 2); }};
constexpr Column kToMultipass{"/multipass", 11,
                              [](const Row& r) { return number(r.ratios.to_multipass, 3); }};
constexpr Column kPsnr{"PSNR", 8, [](const Row& r) { return number(r.accuracy.psnr_db, 2); }};
constexpr Column kMirror{"mirror", 8,
                         [](const Row& r) { return number(r.accuracy.psnr_mirror_db, 2); }};
constexpr Column kFlip{"FLIP", 8, [](const Row& r) { return number(r.accuracy.flip_mean, 4); }};
constexpr Column kHoles{"holes", 6, [](const Row& r) { return count(r.accuracy.holes); }};

constexpr Column kOfMethods[] = {
    kFrameMs,
    kToMultipass,
    {"/bound", 7, [](const Row& r) { return number(r.ratios.to_bound, 2); }},
    {"/mesh", 7, [](const Row& r) { return number(r.ratios.to_mesh, 2); }},
    {"overdraw", 9, [](const Row& r) { return number(r.ratios.overdraw, 2); }},
    {"model MB", 9, [](const Row& r) { return megabytes(r.drawn.model_bytes); }},
    kPsnr,
    kMirror,
    kFlip,
    kHoles};

constexpr Column kOfEngines[] = {
    {"draws", 8,
     [](const Row& r) {
       return std::string(r.input == BenchInput::Points ? "points" : "samples");
     }},
    kFrameMs,
    {"frames", 7, [](const Row& r) { return fmt::format("{}", r.drawn.time.frames); }},
    kToMultipass,
    {"GPU MB", 7, [](const Row& r) { return megabytes(r.drawn.gpu_bytes); }},
    kPsnr,
    {"covered", 8, [](const Row& r) { return number(r.accuracy.psnr_covered_db, 2); }},
    kMirror,
    kFlip,
    {"normal", 7, [](const Row& r) { return number(r.accuracy.normal_rms_deg, 2); }},
    kHoles,
    {"missing", 8, [](const Row& r) { return count(r.accuracy.border_missing); }},
    {"overhang", 9, [](const Row& r) { return count(r.accuracy.border_extra); }}};

std::string table_of(const BenchResult& result, std::span<const Column> columns) {
  std::size_t width = 0;
  for (std::size_t k = 0; k < result.rows.size(); ++k)
    width = std::max(width, name_of_row(result, k).size());
  std::string text = fmt::format("  {:<{}}", "", width);
  for (const Column& column : columns) text += fmt::format(" {:>{}}", column.heading, column.width);
  text += "\n";
  for (std::size_t k = 0; k < result.rows.size(); ++k) {
    const BenchRow& drawn = result.times.rows[k];
    const Row row{result.inputs[k], drawn, result.accuracy[k], ratios_of(result, drawn)};
    text += fmt::format("{} {:<{}}", is_default_row(result, k) ? '*' : ' ', name_of_row(result, k),
                        width);
    for (const Column& column : columns)
      text += fmt::format(" {:>{}}", column.cell(row), column.width);
    text += "\n";
  }
  return text;
}

std::string mesh_text(const BenchResult& result) {
  const auto& mesh = result.times.mesh;
  if (!result.mesh_triangles) return "none: the scene has no faces";
  if (!mesh) return "not drawn: no row is on OpenGL";
  return fmt::format("{:.2f} ms, {} triangles, {} MB", mesh->time.frame_ms, *result.mesh_triangles,
                     megabytes(mesh->model_bytes));
}

/// What --engines adds to the head of the report.
std::string engines_text(const BenchResult& result) {
  return fmt::format(
      "  on the CPU      fewer frames, in turns of their own, after 1\n"
      "  truth           ray traced: {}\n",
      result.truth_is_input ? "the input's faces" : "the patches' own triangles, of all rows");
}

}  // namespace

std::string as_text(const BenchResult& result) {
  const RenderSettings& first = result.rows.front();
  const auto& bound = result.times.shading_bound;
  std::string text = fmt::format(
      "{}{}\n"
      "  renderer        {}\n"
      "  image           {}x{}, {}, {} pixels covered\n"
      "  frames          {} a row in turns, after {}; medians\n"
      "{}"
      "  samples         {}\n"
      "  shading bound   {} ms\n"
      "  input mesh      {}\n\n",
      result.scene, result.view.empty() ? "" : ", view " + result.view, result.times.renderer,
      first.width, first.height, name_of(kMaterials, first.material),
      result.times.rows[result.reference].covered_pixels, result.frames, result.warm_up,
      result.compares_engines ? engines_text(result) : std::string(),
      result.samples[result.reference],
      number(bound ? std::optional(bound->time.frame_ms) : std::nullopt, 2), mesh_text(result));
  text += result.compares_engines ? table_of(result, kOfEngines) : table_of(result, kOfMethods);
  text += "* what `relief render` draws by default\n";
  return text;
}

}  // namespace relief::cli

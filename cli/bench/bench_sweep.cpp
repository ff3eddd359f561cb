#include "cli/bench/bench_sweep.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/options/values.h"
#include "loader/load_files.h"
#include "preprocess/convert.h"
#include "renderer/engine_registry.h"

namespace relief::cli {
namespace {

constexpr std::size_t kMaxValues = 16;

/// The rows of numbers among the options of engines on OpenGL.
std::vector<OptionRow> swept_options() {
  std::vector<OptionRow> rows;
  for (const SharedOption& option : shared_options()) {
    const bool on_opengl =
        std::any_of(option.engines.begin(), option.engines.end(), [](const EngineEntry* engine) {
          return engine->capabilities.needs_opengl && engine->forms.front() == ModelForm::Patches;
        });
    if (on_opengl && option.row.kind != OptionKind::Choice) rows.push_back(option.row);
  }
  return rows;
}

[[noreturn]] void refuse_sweep(const std::string& why) {
  throw CLI::ValidationError(
      "--sweep", fmt::format("expected {}=VALUE,VALUE,...; {}", fmt::join(sweep_keys(), "|"), why));
}

double parse_swept_value(const std::string& key, std::string_view text) {
  const std::vector<OptionRow> rows = swept_options();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&key](const OptionRow& r) { return r.key == key; });
  if (row != rows.end()) {
    const auto value = parse_value(*row, text);
    if (!value) refuse_sweep(value.error().message);
    return std::get<double>(*value);
  }
  const auto value = parse_number(text);
  if (!value || *value <= 0.0)
    refuse_sweep(fmt::format("expected numbers above 0; found {}", text));
  return *value;
}

}  // namespace

std::vector<std::string> sweep_keys() {
  std::vector<std::string> keys{kSpacing, kHeightStep};
  for (const OptionRow& row : swept_options()) keys.push_back(row.key);
  return keys;
}

Sweep parse_sweep(const std::string& text) {
  const std::size_t sign = text.find('=');
  Sweep sweep{text.substr(0, sign), {}};
  const std::vector<std::string> keys = sweep_keys();
  if (sign == std::string::npos || std::find(keys.begin(), keys.end(), sweep.key) == keys.end())
    refuse_sweep("found " + text);
  for (std::size_t at = sign; at != std::string::npos;) {
    const std::size_t next = text.find(',', at + 1);
    sweep.values.push_back(
        parse_swept_value(sweep.key, std::string_view(text).substr(at + 1, next - at - 1)));
    at = next;
  }
  if (sweep.values.size() > kMaxValues)
    refuse_sweep(fmt::format("found {} values, at most {}", sweep.values.size(), kMaxValues));
  return sweep;
}

Result<std::vector<PatchModel>> convert_sweep(const std::filesystem::path& scan, const Sweep& sweep,
                                              Progress& progress) {
  auto read = load_mesh(scan, {}, progress);
  if (!read) return read.error();
  std::vector<PatchModel> models;
  models.reserve(sweep.values.size());
  for (const double value : sweep.values) {
    ConvertOptions options;
    (sweep.key == kSpacing ? options.spacing : options.height_step) = value;
    auto converted = convert(read->points, options, progress);
    if (!converted) {
      return make_error("{}: with {} {}: {}", scan.string(), sweep.key, value,
                        converted.error().message);
    }
    models.push_back(std::move(converted->model));
  }
  return models;
}

}  // namespace relief::cli

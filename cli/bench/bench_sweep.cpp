#include "cli/bench/bench_sweep.h"

#include <CLI/Error.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "cli/options/values.h"
#include "loader/load_files.h"
#include "preprocess/convert.h"

namespace relief::cli {
namespace {

constexpr std::size_t kMaxValues = 16;

[[noreturn]] void refuse(const std::string& why) {
  throw CLI::ValidationError("--sweep",
                             "expected " + list_names(kSwept, "|") + "=VALUE,VALUE,...; " + why);
}

/// None for what a conversion takes: any number above 0.
std::optional<NumberChoice> range_of(Swept what) {
  if (what == Swept::RadiusFactor) return kRadiusFactors;
  if (what == Swept::PixelsPerSample) return kPixelsPerSample;
  return std::nullopt;
}

void check_value(std::optional<NumberChoice> range, std::optional<double> value) {
  if (!range && (!value || *value <= 0.0)) refuse("values are numbers above 0");
  if (range && (!value || *value < range->least || *value > range->most))
    refuse(fmt::format("values are numbers from {:g} to {:g}", range->least, range->most));
}

}  // namespace

Sweep parse_sweep(const std::string& text) {
  const std::size_t sign = text.find('=');
  const auto what = find_named(kSwept, std::string_view(text).substr(0, sign));
  if (!what || sign == std::string::npos) refuse("found " + text);
  Sweep sweep{*what, {}};
  for (std::size_t at = sign; at != std::string::npos;) {
    const std::size_t next = text.find(',', at + 1);
    const auto value = parse_number(std::string_view(text).substr(at + 1, next - at - 1));
    check_value(range_of(*what), value);
    sweep.values.push_back(*value);
    at = next;
  }
  if (sweep.values.size() > kMaxValues) refuse("16 values at most");
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
    (sweep.what == Swept::Spacing ? options.spacing : options.height_step) = value;
    auto converted = convert(read->points, options, progress);
    if (!converted) {
      return make_error("{}: with {} {}: {}", scan.string(), name_of(kSwept, sweep.what), value,
                        converted.error().message);
    }
    models.push_back(std::move(converted->model));
  }
  return models;
}

}  // namespace relief::cli

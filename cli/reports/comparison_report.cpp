#include "cli/reports/comparison_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace relief::cli {
namespace {

using Value = Result<double>;

/// A member of what may not have been measured.
template <class T, class Pick>
Value pick(const Result<T>& measured, const Pick& member) {
  if (!measured) return measured.error();
  return static_cast<double>((*measured).*member);
}

template <auto kMember>
Value coverage(const Comparison& c) {
  return pick(c.coverage, kMember);
}

template <auto kMember>
Value normal(const Comparison& c) {
  return pick(c.normal, kMember);
}

template <auto kMember>
Value depth(const Comparison& c) {
  return pick(c.depth, kMember);
}

Value depth_psnr_db(const Comparison& c) {
  if (!c.depth) return c.depth.error();
  if (!c.depth->psnr_db) return make_error("all depths of the reference are equal");
  return *c.depth->psnr_db;
}

const char* name_of(FlipRange range) {
  return range == FlipRange::Hdr ? "hdr" : "ldr";
}

std::string psnr_text(const Value& value) {
  if (!value) return "not measured: " + value.error().message;
  return std::isfinite(*value) ? fmt::format("{:.2f} dB", *value) : "identical";
}

std::string coverage_text(const Comparison& c) {
  if (!c.coverage) return "not measured: " + c.coverage.error().message;
  return fmt::format("{} holes, {} missing and {} extra at the border, of {} covered pixels",
                     c.coverage->holes, c.coverage->border_missing, c.coverage->border_extra,
                     c.coverage->covered_reference);
}

std::string normal_text(const Comparison& c) {
  if (!c.normal) return "not measured: " + c.normal.error().message;
  return fmt::format("{:.4g} degrees rms, 99 % within {:.4g} degrees", c.normal->rms_deg,
                     c.normal->p99_deg);
}

std::string depth_text(const Comparison& c) {
  if (!c.depth) return "not measured: " + c.depth.error().message;
  return fmt::format("{:.4g} of the depth rms, 99 % within {:.4g}", c.depth->rms_relative,
                     c.depth->p99_relative);
}

std::string flip_text(const Comparison& c, const FlipOptions& options) {
  std::string text = fmt::format("{:.6f} mean, {}", c.flip.mean, name_of(options.range));
  if (options.range == FlipRange::Hdr) {
    text += fmt::format(", {} exposures from {:.2f} to {:.2f}", c.flip.exposures.count,
                        c.flip.exposures.start, c.flip.exposures.stop);
  }
  return text;
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = {
      {"psnr_db", false, [](const Comparison& c) { return Value(c.psnr_db); }},
      {"flip_mean", false, [](const Comparison& c) { return Value(c.flip.mean); }},
      {"normal_rms_deg", false, normal<&NormalErrors::rms_deg>},
      {"normal_p99_deg", false, normal<&NormalErrors::p99_deg>},
      {"depth_rms_relative", false, depth<&DepthErrors::rms_relative>},
      {"holes", true, coverage<&CoverageErrors::holes>},
      {"border_missing", true, coverage<&CoverageErrors::border_missing>},
      {"border_extra", true, coverage<&CoverageErrors::border_extra>},
      {"pixels", true,
       [](const Comparison& c) { return Value(static_cast<double>(c.width) * c.height); }},
      {"depth_p99_relative", false, depth<&DepthErrors::p99_relative>},
      {"psnr_covered_db", false, [](const Comparison& c) { return c.psnr_covered_db; }},
      {"psnr_alpha_db", false, [](const Comparison& c) { return c.psnr_alpha_db; }},
      {"psnr_normal_db", false, normal<&NormalErrors::psnr_db>},
      {"psnr_depth_db", false, depth_psnr_db},
      {"psnr_uv_db", false, [](const Comparison& c) { return c.psnr_uv_db; }},
      {"covered_reference", true, coverage<&CoverageErrors::covered_reference>},
      {"covered_both", true, coverage<&CoverageErrors::covered_both>},
      {"non_finite", true,
       [](const Comparison& c) { return Value(static_cast<double>(c.non_finite)); }},
      {"non_finite_reference", true,
       [](const Comparison& c) { return Value(static_cast<double>(c.non_finite_reference)); }},
  };
  return all;
}

nlohmann::ordered_json as_json(const Comparison& comparison, const FlipOptions& options) {
  nlohmann::ordered_json json;
  for (const Quantity& quantity : quantities()) {
    const Value value = quantity.measure(comparison);
    if (!value || !std::isfinite(*value)) {
      json[quantity.key] = nullptr;
    } else if (quantity.is_count) {
      json[quantity.key] = static_cast<std::uint64_t>(*value);
    } else {
      json[quantity.key] = *value;
    }
  }
  json["identical"] = comparison.identical;
  json["width"] = comparison.width;
  json["height"] = comparison.height;
  json["flip"] = name_of(options.range);
  json["pixels_per_degree"] = options.pixels_per_degree;
  json["exposure_start"] = nullptr;
  json["exposure_stop"] = nullptr;
  if (options.range == FlipRange::Hdr) {
    json["exposure_start"] = comparison.flip.exposures.start;
    json["exposure_stop"] = comparison.flip.exposures.stop;
  }
  return json;
}

std::string as_text(const Comparison& c, const FlipOptions& options) {
  std::string text = fmt::format(
      "  size      {}x{}\n"
      "  colour    {}\n"
      "  covered   {}\n"
      "  FLIP      {}\n"
      "  coverage  {}\n"
      "  normal    {}\n"
      "  depth     {}\n"
      "  UV        {}\n"
      "  alpha     {}\n",
      c.width, c.height, psnr_text(c.psnr_db), psnr_text(c.psnr_covered_db), flip_text(c, options),
      coverage_text(c), normal_text(c), depth_text(c), psnr_text(c.psnr_uv_db),
      psnr_text(c.psnr_alpha_db));
  if (c.non_finite + c.non_finite_reference > 0) {
    text += fmt::format("  no number {} pixels, {} in the reference\n", c.non_finite,
                        c.non_finite_reference);
  }
  return text;
}

}  // namespace relief::cli

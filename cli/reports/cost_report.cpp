#include "cli/reports/cost_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "cli/reports/json_values.h"

namespace relief::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Of the sections that a frame reads.
std::optional<std::uint64_t> file_bytes_of(const FrameCost& frame, const FileBytes& read) {
  if (!read) return std::nullopt;
  return read->heights + read->scalars + (frame.reads_normals ? read->normals : 0) +
         (frame.reads_colours ? read->colours : 0);
}

/// Of the sections that nothing but the feature reads.
std::optional<std::uint64_t> file_bytes_of(const FeatureCost& cost, const FileBytes& read) {
  if (!read) return std::nullopt;
  return (cost.reads_normals ? read->normals : 0) + (cost.reads_colours ? read->colours : 0);
}

/// "a, b x 3": each name once, where it is first, with the sign before it.
std::string pass_names(const std::vector<std::string>& passes, std::string_view sign) {
  std::vector<std::string> names;
  for (auto pass = passes.begin(); pass != passes.end(); ++pass) {
    if (std::find(passes.begin(), pass, *pass) != pass) continue;
    const auto count = std::count(pass, passes.end(), *pass);
    names.push_back(count == 1 ? fmt::format("{}{}", sign, *pass)
                               : fmt::format("{}{} x {}", sign, *pass, count));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Json frame_as_json(const FrameCost& frame, const FileBytes& read) {
  return {{"gpu_bytes", frame.bytes},
          {"file_bytes", value_or_null(file_bytes_of(frame, read))},
          {"passes", frame.passes},
          {"shader_lines", frame.lines},
          {"frame_ms", frame.frame_ms}};
}

std::string number(const std::optional<std::uint64_t>& bytes) {
  return bytes ? fmt::format("{}", *bytes) : std::string("-");
}

constexpr const char* kRow = "    {:<26} {:>13} {:>13} {:>7} {:>16}  {}\n";

std::string row_of_frame(const char* name, const FrameCost& frame, const FileBytes& read) {
  return fmt::format(fmt::runtime(kRow), name, frame.bytes, number(file_bytes_of(frame, read)),
                     frame.lines, fmt::format("{:.2f}        ", frame.frame_ms),
                     pass_names(frame.passes, ""));
}

std::string row_of(const FeatureCost& cost, const FileBytes& read) {
  const bool has_both = !cost.passes.empty() && !cost.saved_passes.empty();
  return fmt::format(
      fmt::runtime(kRow), cost.feature, fmt::format("{:+}", cost.bytes),
      number(file_bytes_of(cost, read)), fmt::format("{:+}", cost.lines),
      fmt::format("{:+.2f} +-{:>5.2f}", cost.frame_ms, cost.spread_ms / 2.0),
      pass_names(cost.passes, "+") + (has_both ? ", " : "") + pass_names(cost.saved_passes, "-"));
}

}  // namespace

Json as_json(const FileBytes& read) {
  if (!read) return nullptr;
  return {{"heights", read->heights},
          {"normals", read->normals},
          {"colours", read->colours},
          {"scalars", read->scalars}};
}

Json as_json(const FeatureCosts& costs, const FileBytes& read) {
  Json features = Json::array();
  for (const FeatureCost& cost : costs.features) {
    features.push_back({{"feature", cost.feature},
                        {"instead", cost.instead},
                        {"gpu_bytes", cost.bytes},
                        {"file_bytes", value_or_null(file_bytes_of(cost, read))},
                        {"passes", cost.passes},
                        {"saved_passes", cost.saved_passes},
                        {"shader_lines", cost.lines},
                        {"frame_ms", cost.frame_ms},
                        {"spread_ms", cost.spread_ms}});
  }
  return {{"turns", costs.turns},
          {"whole", frame_as_json(costs.whole, read)},
          {"rest", frame_as_json(costs.rest, read)},
          {"features", std::move(features)}};
}

std::string as_text(const FeatureCosts& costs, const FileBytes& read) {
  std::string text =
      fmt::format("  what features cost: the frame less one without, {} turns\n", costs.turns);
  text += fmt::format(fmt::runtime(kRow), "", "GPU bytes", "file bytes", "lines", "ms        ",
                      "passes");
  text += row_of_frame("whole frame", costs.whole, read);
  for (const FeatureCost& cost : costs.features) text += row_of(cost, read);
  return text + row_of_frame("without all of these", costs.rest, read);
}

}  // namespace relief::cli

#include "renderer/clip/options.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/engine_options.h"

namespace relief {
namespace {

constexpr std::string_view kAuto = "auto";

/// A number in the range of thresholds, and nothing else.
std::optional<double> parse_threshold(std::string_view text) {
  double threshold = 0.0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, threshold);
  const bool is_number = error == std::errc() && parsed == end;
  if (!is_number || !(threshold >= kClipThresholds.min && threshold <= kClipThresholds.max))
    return std::nullopt;
  return threshold;
}

/// Without clipping the other options are off, too.
bool is_off(const RenderSettings& settings) {
  return settings.clip.rule == ClipRule::Off;
}

EngineOption rule_option() {
  EngineOption option = choice_option(
      {.key = "clip-partners",
       .help = "how splats that cross a sharp edge are clipped: partners unites or intersects what "
               "their partners clip, the others are for comparison",
       .default_text = "off"},
      kClipRules,
      {ClipRule::Off, ClipRule::Partners, ClipRule::Nearest, ClipRule::Independent,
       ClipRule::Wicke},
      [](RenderSettings& settings) -> ClipRule& { return settings.clip.rule; });
  option.get = [get = option.get](const RenderSettings& settings) {
    return is_off(settings) ? std::nullopt : get(settings);
  };
  return option;
}

EngineOption threshold_option() {
  OptionRow row{
      .key = "clip-threshold",
      .kind = OptionKind::Text,
      .placeholder = "W|auto",
      .help =
          "splats whose normals have a smaller dot product lie on both sides of a "
          "sharp edge; -1 to 1, auto measures the noise of the normals",
      .default_text = "auto",
      .accepts_text = [](std::string_view text) { return text == kAuto || parse_threshold(text); },
      .expected_text = "auto or a number from -1 to 1"};
  return {std::move(row),
          [](RenderSettings& settings, const OptionValue& value) {
            settings.clip.threshold = parse_threshold(std::get<std::string>(value));
          },
          [](const RenderSettings& settings) -> std::optional<OptionValue> {
            if (is_off(settings)) return std::nullopt;
            const std::optional<double>& threshold = settings.clip.threshold;
            return threshold ? fmt::format("{}", *threshold) : std::string(kAuto);
          }};
}

EngineOption normals_option() {
  EngineOption option = choice_option(
      {.key = "clip-normals",
       .help = "the normals that clip partners are found with: those given, or refitted to the "
               "neighbours on the same side of an edge, for noisy scans and points on edges; ewa "
               "and surfel draw these, too",
       .default_text = "given"},
      kClipNormals, {ClipNormals::Given, ClipNormals::Refit},
      [](RenderSettings& settings) -> ClipNormals& { return settings.clip.normals; });
  option.get = [get = option.get](const RenderSettings& settings) {
    return is_off(settings) ? std::nullopt : get(settings);
  };
  return option;
}

}  // namespace

std::vector<EngineOption> clip_options() {
  return {rule_option(), threshold_option(), normals_option()};
}

}  // namespace relief

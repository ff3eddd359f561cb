// What `relief bench --trade` varies, and settings of all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/options/quality.h"
#include "common/scene/option.h"

namespace relief::cli {

/// What has to be done again when a knob is turned.
enum class TradeStage : std::uint8_t { Convert, File, Render };

/// A position of a knob: options of `relief convert` or `relief render` by their names without
/// dashes. Of Render, `engine` is one of them.
struct TradeChoice {
  std::string label;
  OptionValues options;
};

struct TradeKnob {
  std::string name;
  TradeStage stage = TradeStage::Convert;
  bool is_ordered = false;  ///< from coarse to fine: a step goes to the next choice, not to any
  std::vector<TradeChoice> choices;
  std::size_t usual = 0;  ///< what `relief convert` and `relief render` do by default
};

/// The index of a choice for each knob.
using TradeSetting = std::vector<std::size_t>;

/// All that is varied, what trades most last. Ways to draw come from the registry of engines.
[[nodiscard]] std::vector<TradeKnob> trade_knobs();

[[nodiscard]] TradeSetting usual_setting(const std::vector<TradeKnob>& knobs);

/// The setting of a preset, whose options are all among the knobs' choices.
[[nodiscard]] TradeSetting setting_of(const std::vector<TradeKnob>& knobs,
                                      const QualityPreset& preset);

/// All settings that differ from one in one knob, without those whose engine lacks a chosen option.
/// The last knob first, so that what trades most is known even where time is short.
[[nodiscard]] std::vector<TradeSetting> single_changes(const std::vector<TradeKnob>& knobs,
                                                       const TradeSetting& from);

/// Those of them that are a step away: the next choice of an ordered knob, any of another.
[[nodiscard]] std::vector<TradeSetting> steps_from(const std::vector<TradeKnob>& knobs,
                                                   const TradeSetting& from);

/// The options that the setting chooses in a stage.
[[nodiscard]] OptionValues options_of(const std::vector<TradeKnob>& knobs,
                                      const TradeSetting& setting, TradeStage stage);

/// The choices that differ from the defaults, "compact, normals 2 degrees; multipass quad", or
/// "default".
[[nodiscard]] std::string name_of(const std::vector<TradeKnob>& knobs, const TradeSetting& setting);

/// The commands that make the file and the picture.
[[nodiscard]] std::string convert_command(const std::vector<TradeKnob>& knobs,
                                          const TradeSetting& setting);
[[nodiscard]] std::string render_command(const std::vector<TradeKnob>& knobs,
                                         const TradeSetting& setting);

}  // namespace relief::cli

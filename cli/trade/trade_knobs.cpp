#include "cli/trade/trade_knobs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <variant>

#include "cli/bench/bench_engines.h"
#include "loader/scene/first_look.h"
#include "renderer/engine_registry.h"

namespace relief::cli {
namespace {

constexpr const char* kEngineKey = "engine";

/// A knob of one numeric option. Without `usual` among the values, the default is to give none;
/// it then stands before the first value above `usual`.
TradeKnob number_knob(const std::string& key, TradeStage stage, const std::vector<double>& values,
                      double usual, const std::string& usual_label) {
  TradeKnob knob{key, stage, true, {}, 0};
  bool has_usual = false;
  for (const double value : values) {
    if (!has_usual && value >= usual) {
      knob.usual = knob.choices.size();
      knob.choices.push_back({usual_label, {}});
      has_usual = true;
      if (value == usual) continue;
    }
    knob.choices.push_back({fmt::format("{} {:g}", key, value), {{key, value}}});
  }
  assert(has_usual && "the default lies among the values");
  return knob;
}

/// Normals of the codec `fast` are kept to 0.1 degrees; 90 stores none.
TradeKnob file_knob() {
  TradeKnob knob{"normal precision and codec", TradeStage::File, true, {}, 0};
  for (const double degrees : {90.0, 5.0, 2.0, 1.0, 0.5, 0.1}) {
    OptionValues options{{"codec", std::string("compact")}};
    if (degrees != PatchFileOptions().normal_degrees) options.emplace("normal-degrees", degrees);
    knob.choices.push_back({fmt::format("compact, normals {:g} degrees", degrees), options});
  }
  knob.usual = knob.choices.size();
  knob.choices.push_back({"fast", {}});
  return knob;
}

/// Each engine that draws surfaces of patches, with each of its primitives and interpolations.
TradeKnob method_knob() {
  TradeKnob knob{"way to draw", TradeStage::Render, false, {}, 0};
  for (const EngineEntry* const engine : comparable_engines()) {
    std::vector<TradeChoice> ways{{engine->name, {{kEngineKey, engine->name}}}};
    const auto multiply = [&ways](const std::string& key, const std::vector<std::string>& names) {
      if (names.empty()) return;
      std::vector<TradeChoice> more;
      for (const TradeChoice& way : ways) {
        for (const std::string& name : names) {
          TradeChoice choice{fmt::format("{} {}", way.label, name), way.options};
          choice.options.emplace(key, name);
          more.push_back(std::move(choice));
        }
      }
      ways = std::move(more);
    };
    std::vector<std::string> primitives;
    for (const Primitive primitive : engine->primitives)
      primitives.emplace_back(relief::name_of(kPrimitives, primitive));
    std::vector<std::string> interpolations;
    for (const Interpolation interpolation : engine->interpolations)
      interpolations.emplace_back(relief::name_of(kInterpolations, interpolation));
    multiply("primitive", primitives);
    multiply("interpolation", interpolations);
    for (TradeChoice& way : ways) knob.choices.push_back(std::move(way));
  }
  return knob;  // the registry has the default engine first, and that its defaults
}

const EngineEntry& engine_drawn(const std::vector<TradeKnob>& knobs, const TradeSetting& setting) {
  const OptionValues options = options_of(knobs, setting, TradeStage::Render);
  const EngineEntry* const engine = find_engine(std::get<std::string>(options.at(kEngineKey)));
  assert(engine != nullptr && "ways to draw are made of the registry's engines");
  return *engine;
}

/// Whether the engine has all options that differ from the defaults.
bool is_possible(const std::vector<TradeKnob>& knobs, const TradeSetting& setting) {
  const EngineEntry& engine = engine_drawn(knobs, setting);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].stage != TradeStage::Render || setting[k] == knobs[k].usual) continue;
    for (const auto& [key, value] : knobs[k].choices[setting[k]].options) {
      if (key != kEngineKey && find_option(engine, key) == nullptr) return false;
    }
  }
  return true;
}

std::vector<TradeSetting> changes(const std::vector<TradeKnob>& knobs, const TradeSetting& from,
                                  bool only_steps) {
  std::vector<TradeSetting> found;
  for (std::size_t k = knobs.size(); k-- > 0;) {
    for (std::size_t choice = 0; choice < knobs[k].choices.size(); ++choice) {
      const std::size_t apart = choice > from[k] ? choice - from[k] : from[k] - choice;
      if (apart == 0 || (only_steps && knobs[k].is_ordered && apart > 1)) continue;
      TradeSetting changed = from;
      changed[k] = choice;
      if (is_possible(knobs, changed)) found.push_back(std::move(changed));
    }
  }
  return found;
}

std::string text_of(const OptionValue& value) {
  if (const double* const number = std::get_if<double>(&value)) return fmt::format("{:g}", *number);
  return std::get<std::string>(value);
}

/// The options that differ from the defaults, as on a command line.
std::string words_of(const std::vector<TradeKnob>& knobs, const TradeSetting& setting,
                     bool is_picture) {
  std::string words;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if ((knobs[k].stage == TradeStage::Render) != is_picture || setting[k] == knobs[k].usual)
      continue;
    for (const auto& [key, value] : knobs[k].choices[setting[k]].options)
      words += fmt::format(" --{} {}", key, text_of(value));
  }
  return words;
}

}  // namespace

std::vector<TradeKnob> trade_knobs() {
  std::vector<TradeKnob> knobs;
  knobs.push_back(number_knob("cone-degrees", TradeStage::Convert, {30.0, 50.0, 70.0, 85.0}, 70.0,
                              "cone 70 degrees"));
  knobs.push_back(number_knob("steps-per-spacing", TradeStage::Convert, {5.0, 10.0, 20.0, 40.0},
                              kUsualStepsPerSpacing, "20 steps"));
  knobs.push_back(method_knob());
  // The default is 1 sample a point of bare points, and 1.1 to 2 of meshes.
  knobs.push_back(number_knob("samples-per-point", TradeStage::Convert,
                              {0.0625, 0.125, 0.25, 0.5, 2.0}, 1.0, "default samples"));
  knobs.push_back(file_knob());
  knobs.push_back(number_knob("pixels-per-sample", TradeStage::Render,
                              {0.0, 1.0, 2.0, 4.0, 8.0, 16.0}, kPixelsPerSampleOfCells,
                              "4 pixels a sample"));
  TradeKnob samples = number_knob("samples", TradeStage::Render, {1.0, 4.0, 16.0},
                                  static_cast<double>(kPictureSamples), "4 samples a pixel");
  // Set, because rows of a bench have one sample a pixel by default, and pictures have more.
  samples.choices[samples.usual].options = {{"samples", static_cast<double>(kPictureSamples)}};
  knobs.push_back(std::move(samples));
  return knobs;
}

TradeSetting usual_setting(const std::vector<TradeKnob>& knobs) {
  TradeSetting setting;
  for (const TradeKnob& knob : knobs) setting.push_back(knob.usual);
  return setting;
}

TradeSetting setting_of(const std::vector<TradeKnob>& knobs, const QualityPreset& preset) {
  TradeSetting setting = usual_setting(knobs);
  OptionValues wanted = overlay_options(preset.convert, preset.render);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    for (std::size_t choice = 0; choice < knobs[k].choices.size(); ++choice) {
      const OptionValues& options = knobs[k].choices[choice].options;
      const bool fits = !options.empty() &&
                        std::all_of(options.begin(), options.end(), [&wanted](const auto& option) {
                          const auto found = wanted.find(option.first);
                          return found != wanted.end() && found->second == option.second;
                        });
      // Of several, the one that says most: "compact" alone is a part of "compact, 2 degrees".
      if (fits && options.size() >= knobs[k].choices[setting[k]].options.size())
        setting[k] = choice;
    }
  }
  return setting;
}

std::vector<TradeSetting> single_changes(const std::vector<TradeKnob>& knobs,
                                         const TradeSetting& from) {
  return changes(knobs, from, false);
}

std::vector<TradeSetting> steps_from(const std::vector<TradeKnob>& knobs,
                                     const TradeSetting& from) {
  return changes(knobs, from, true);
}

OptionValues options_of(const std::vector<TradeKnob>& knobs, const TradeSetting& setting,
                        TradeStage stage) {
  OptionValues options;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].stage == stage)
      options = overlay_options(std::move(options), knobs[k].choices[setting[k]].options);
  }
  return options;
}

std::string name_of(const std::vector<TradeKnob>& knobs, const TradeSetting& setting) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (setting[k] != knobs[k].usual) parts.push_back(knobs[k].choices[setting[k]].label);
  }
  return parts.empty() ? "default" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string convert_command(const std::vector<TradeKnob>& knobs, const TradeSetting& setting) {
  return "relief convert SCAN -o OUT.relief" + words_of(knobs, setting, false);
}

std::string render_command(const std::vector<TradeKnob>& knobs, const TradeSetting& setting) {
  return "relief render OUT.relief -o OUT.png" + words_of(knobs, setting, true);
}

}  // namespace relief::cli

// Makes the rows of engines' option tables.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "renderer/engine.h"

namespace relief {

/// An option whose number is a member of RenderSettings: `member(settings)` refers to it. An
/// integral member makes it a whole number.
template <class Member>
[[nodiscard]] EngineOption number_option(OptionRow row, Member member) {
  using T = std::remove_reference_t<std::invoke_result_t<Member, RenderSettings&>>;
  row.kind = std::is_integral_v<T> ? OptionKind::Integer : OptionKind::Number;
  return {std::move(row),
          [member](RenderSettings& settings, const OptionValue& value) {
            member(settings) = static_cast<T>(std::get<double>(value));
          },
          [member](const RenderSettings& settings) {
            RenderSettings copy = settings;
            return std::optional<OptionValue>(static_cast<double>(member(copy)));
          }};
}

/// An option whose number may be left to the engine: `member(settings)` refers to an optional
/// double.
template <class Member>
[[nodiscard]] EngineOption optional_number_option(OptionRow row, Member member) {
  row.kind = OptionKind::Number;
  return {std::move(row),
          [member](RenderSettings& settings, const OptionValue& value) {
            member(settings) = std::get<double>(value);
          },
          [member](const RenderSettings& settings) -> std::optional<OptionValue> {
            RenderSettings copy = settings;
            const std::optional<double>& number = member(copy);
            if (!number) return std::nullopt;
            return *number;
          }};
}

/// An option whose choice is a member of RenderSettings, with the names that `names` gives its
/// values.
template <class Member, class T, std::size_t N>
[[nodiscard]] EngineOption choice_option(OptionRow row, const std::array<Named<T>, N>& names,
                                         const std::vector<T>& values, Member member) {
  row.kind = OptionKind::Choice;
  for (const T value : values) row.choices.emplace_back(name_of(names, value));
  return {std::move(row),
          [&names, member](RenderSettings& settings, const OptionValue& value) {
            const auto found = find_named(names, std::get<std::string>(value));
            assert(found && "a choice of the option's row");
            member(settings) = *found;
          },
          [&names, member](const RenderSettings& settings) {
            RenderSettings copy = settings;
            return std::optional<OptionValue>(std::string(name_of(names, member(copy))));
          }};
}

/// An engine's own option: its value is kept in RenderSettings::options. `fallback`: the default.
[[nodiscard]] EngineOption own_option(OptionRow row, OptionValue fallback);

/// Options that several engines have.
[[nodiscard]] EngineOption primitive_option(const std::vector<Primitive>& primitives);
[[nodiscard]] EngineOption interpolation_option(const std::vector<Interpolation>& interpolations);
[[nodiscard]] EngineOption cull_option();
[[nodiscard]] EngineOption samples_option();  ///< of the engines on OpenGL
/// Of engines with levels of detail, which say what theirs are. `in_force`: the value that an
/// engine draws with.
[[nodiscard]] EngineOption pixels_per_sample_option(std::string help, std::string default_text,
                                                    double (*in_force)(const RenderSettings&));

}  // namespace relief

// Parses option values that are more than one number. A wrong value throws CLI::ValidationError,
// which CLI11 turns into a message and exit code 2.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/camera.h"
#include "common/scene/choices.h"
#include "common/scene/scene.h"

namespace relief::cli {

/// "WxH", each 1 to 32768.
[[nodiscard]] ImageSize parse_size(const std::string& text);

/// A finite number, or nothing if the text is none.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// A whole number from 0 on, or nothing if the text is none.
[[nodiscard]] std::optional<unsigned> parse_whole(std::string_view text);

/// The parts between separators, empty ones included.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);

/// The numbers of a comma-separated list, or nothing if an element is not a finite number.
[[nodiscard]] std::vector<double> parse_numbers(std::string_view text);

/// Refuses what is no number above 0 and at most 1e100.
[[nodiscard]] CLI::Validator positive_number();

/// Refuses what is no number of a range.
[[nodiscard]] CLI::Validator number_from(double least, double most);

/// Refuses fewer bytes than `least`, which has the unit M. Sees bytes, whatever unit the user
/// chose; follows CLI::AsSizeValue.
[[nodiscard]] CLI::Validator bytes_from(std::uint64_t least);

/// Refuses what is no whole number of a range.
[[nodiscard]] CLI::Validator count_from(std::uint64_t least, std::uint64_t most);

/// Replaces a name by its value, as number; refuses any other.
template <class T>
[[nodiscard]] CLI::Validator one_of(const std::map<std::string, T>& values) {
  const auto replace = [values](std::string& text) -> std::string {
    if (const auto found = values.find(text); found != values.end()) {
      text = std::to_string(static_cast<int>(found->second));
      return {};
    }
    std::string names;
    for (const auto& [name, value] : values) names += (names.empty() ? "" : ", ") + name;
    return "expected one of " + names + "; found " + text;
  };
  return {replace, ""};
}

/// "AZ,EL" or "AZ,EL,DIST": degrees, and bounding-sphere radii above 0.
[[nodiscard]] Orbit parse_orbit(const std::string& text);

/// The name of a direction of view: front, back, left, right, top, bottom or iso.
[[nodiscard]] Orbit parse_view(const std::string& text);

/// "x", "-x" and so on for the other axes, or "X,Y,Z" of any length but 0.
[[nodiscard]] glm::dvec3 parse_up(const std::string& text);

/// "fit", or a height above 0.
[[nodiscard]] OrthographicSize parse_orthographic(const std::string& text);

/// "X,Y,Z", finite.
[[nodiscard]] glm::dvec3 parse_vector(const std::string& text);

/// "R,G,B", sRGB values in [0, 1], as linear RGB; or "none".
[[nodiscard]] Background parse_background(const std::string& text);

/// "R,G,B", exponents from 0 to 100.
[[nodiscard]] glm::vec3 parse_absorption(const std::string& text);

/// "all", "colour", or names of normal, depth, uv, patch, separated by commas.
[[nodiscard]] Outputs parse_outputs(const std::string& text);

}  // namespace relief::cli

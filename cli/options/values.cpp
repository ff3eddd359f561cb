#include "cli/options/values.h"

#include <CLI/Error.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "common/image/srgb.h"

namespace relief::cli {
namespace {

template <class Number>
std::optional<Number> parse_as(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t at = text.find(separator); at != std::string_view::npos;
       at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.push_back(text);
  return parts;
}

std::optional<unsigned> parse_whole(std::string_view text) {
  return parse_as<unsigned>(text);
}

std::optional<double> parse_number(std::string_view text) {
  const auto number = parse_as<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::vector<double> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ',')) {
    const auto number = parse_number(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

ImageSize parse_size(const std::string& text) {
  const auto parts = split(text, 'x');
  if (parts.size() == 2) {
    const auto width = parse_as<std::uint32_t>(parts[0]);
    const auto height = parse_as<std::uint32_t>(parts[1]);
    if (width && height && *width >= 1 && *width <= kMaxRenderSide && *height >= 1 &&
        *height <= kMaxRenderSide) {
      return {*width, *height};
    }
  }
  throw CLI::ValidationError(
      "--size", "expected WIDTHxHEIGHT, each 1 to 32768, as in 1280x1024; found " + text);
}

CLI::Validator positive_number() {
  const auto complain = [](const std::string& text) -> std::string {
    const std::optional<double> number = parse_number(text);
    if (number && *number > 0.0 && *number <= 1e100) return {};
    return fmt::format("expected a number above 0, at most 1e100; found {}", text);
  };
  return {complain, ""};
}

CLI::Validator number_from(double least, double most) {
  const auto complain = [least, most](const std::string& text) -> std::string {
    const std::optional<double> number = parse_number(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("expected a number from {:g} to {:g}; found {}", least, most, text);
  };
  return {complain, ""};
}

CLI::Validator bytes_from(std::uint64_t least) {
  const auto complain = [least](const std::string& text) {
    const auto bytes = parse_number(text);
    return bytes && *bytes >= static_cast<double>(least) && *bytes <= 0x1p50
               ? std::string()
               : fmt::format("expected {}M or more; found {} bytes", least >> 20U, text);
  };
  return {complain, ""};
}

CLI::Validator count_from(std::uint64_t least, std::uint64_t most) {
  const auto complain = [least, most](const std::string& text) -> std::string {
    const auto number = parse_as<std::uint64_t>(text);
    if (number && *number >= least && *number <= most) return {};
    return fmt::format("expected a whole number from {} to {}; found {}", least, most, text);
  };
  return {complain, ""};
}

Orbit parse_orbit(const std::string& text) {
  const auto numbers = parse_numbers(text);
  if (numbers.size() == 2) return {numbers[0], numbers[1], 0.0};
  if (numbers.size() == 3 && numbers[2] > 0.0) return {numbers[0], numbers[1], numbers[2]};
  throw CLI::ValidationError(
      "--orbit",
      "expected AZIMUTH,ELEVATION[,DISTANCE] with DISTANCE above 0, as in 30,20,1.5; found " +
          text);
}

Orbit parse_view(const std::string& text) {
  if (const auto orbit = find_named(kViews, text)) return *orbit;
  throw CLI::ValidationError("--view", "expected " + list_names(kViews, ", ") + "; found " + text);
}

glm::dvec3 parse_up(const std::string& text) {
  if (const auto axis = find_named(kAxes, text)) return *axis;
  const auto numbers = parse_numbers(text);
  if (numbers.size() == 3 && (numbers[0] != 0.0 || numbers[1] != 0.0 || numbers[2] != 0.0))
    return {numbers[0], numbers[1], numbers[2]};
  throw CLI::ValidationError(
      "--up", "expected " + list_names(kAxes, ", ") + ", or X,Y,Z other than 0,0,0; found " + text);
}

OrthographicSize parse_orthographic(const std::string& text) {
  if (text == "fit") return {};
  const auto height = parse_number(text);
  if (height && *height >= kOrthographicHeights.min && *height <= kOrthographicHeights.max)
    return {height};
  throw CLI::ValidationError("--orthographic",
                             "expected the image's height in the model's coordinates, above 0, "
                             "or fit; found " +
                                 text);
}

glm::dvec3 parse_vector(const std::string& text) {
  const auto numbers = parse_numbers(text);
  if (numbers.size() != 3) throw CLI::ValidationError("expected X,Y,Z, as in 0,1,0; found " + text);
  return {numbers[0], numbers[1], numbers[2]};
}

Background parse_background(const std::string& text) {
  if (text == "none") return {};
  const auto numbers = parse_numbers(text);
  const auto in_range = [](double n) { return n >= 0.0 && n <= 1.0; };
  if (numbers.size() != 3 || !std::all_of(numbers.begin(), numbers.end(), in_range)) {
    throw CLI::ValidationError(
        "--background",
        "expected R,G,B, sRGB values from 0 to 1 as in 1,1,1, or none; found " + text);
  }
  const auto linear = [](double n) { return linear_from_srgb(static_cast<float>(n)); };
  return {glm::vec3(linear(numbers[0]), linear(numbers[1]), linear(numbers[2]))};
}

Light parse_light(const std::string& text) {
  constexpr std::string_view kPoint = "point:";
  Light light;
  const bool is_point = text.starts_with(kPoint);
  const auto n = parse_numbers(std::string_view(text).substr(is_point ? kPoint.size() : 0));
  const double most = is_point ? kMaxPointLight : kMaxLight;
  const bool has_colour = n.size() == 6;
  const bool is_good =
      (n.size() == 3 || has_colour) &&
      std::all_of(n.begin() + 3, n.end(), [most](double c) { return c >= 0.0 && c <= most; });
  const glm::dvec3 position = is_good ? glm::dvec3(n[0], n[1], n[2]) : glm::dvec3(0.0);
  const double length = glm::length(position);
  constexpr double kShortestDirection = 1e-12;
  if (!is_good || (!is_point && !(length > kShortestDirection && std::isfinite(length)))) {
    throw CLI::ValidationError(
        "--light",
        fmt::format("expected X,Y,Z or X,Y,Z,R,G,B, with point: before it where a light is, "
                    "colours from 0 to {:g}; found {}",
                    most, text));
  }
  // What is of length 1 stays as it is.
  constexpr double kRounding = 1e-15;
  const bool is_unit = std::abs(length - 1.0) <= kRounding;
  light.kind = is_point ? LightKind::Point : LightKind::Directional;
  light.position = is_point || is_unit ? position : position / length;
  if (has_colour) light.colour = {n[3], n[4], n[5]};
  return light;
}

glm::vec3 parse_ambient(const std::string& text) {
  const auto n = parse_numbers(text);
  const auto in_range = [](double c) { return c >= 0.0 && c <= kMaxLight; };
  if (n.size() != 3 || !std::all_of(n.begin(), n.end(), in_range)) {
    throw CLI::ValidationError(
        "--ambient", "expected R,G,B, linear, each 0 to 1000, as in 0.1,0.1,0.1; found " + text);
  }
  return {n[0], n[1], n[2]};
}

glm::vec3 parse_absorption(const std::string& text) {
  const auto numbers = parse_numbers(text);
  const auto in_range = [](double n) { return n >= kAbsorptions.min && n <= kAbsorptions.max; };
  if (numbers.size() != 3 || !std::all_of(numbers.begin(), numbers.end(), in_range)) {
    throw CLI::ValidationError(
        "--absorption", "expected R,G,B, exponents from 0 to 100 as in 2,0.5,0.3; found " + text);
  }
  return {numbers[0], numbers[1], numbers[2]};
}

Outputs parse_outputs(const std::string& text) {
  Outputs outputs;
  for (const std::string_view name : split(text, ',')) {
    if (name == "all") {
      outputs = {true, true, true, true};
    } else if (name != "color" && !add_output(outputs, name)) {
      throw CLI::ValidationError(
          "--outputs", "expected all, colour, or some of normal,depth,uv,patch,clip; found " +
                           std::string(name));
    }
  }
  return outputs;
}

}  // namespace relief::cli

#include "common/scene/json_values.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace relief {
namespace {

using nlohmann::json;

/// A value in the middle of a sentence: short, and with nothing that a terminal would obey.
std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return value.empty() ? "an empty list" : "a list";
  constexpr std::size_t kMaxShown = 60;
  std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  if (text.size() > kMaxShown) text = text.substr(0, kMaxShown) + "...";
  return text;
}

std::string path_of(const std::string& parent, std::string_view key) {
  return parent.empty() ? std::string(key) : fmt::format("{}.{}", parent, key);
}

}  // namespace

void JsonValues::refuse(const std::string& path, std::string_view clause) {
  if (error_) return;
  error_ = path.empty() ? make_error("{}: {}", file_, clause)
                        : make_error("{}: {}: {}", file_, path, clause);
}

void JsonValues::refuse_value(const JsonPlace& place, std::string_view expected) {
  refuse(place.path, fmt::format("expected {}; found {}", expected, shown(place.value)));
}

bool JsonValues::object(const JsonPlace& place, const std::vector<std::string_view>& keys) {
  if (!place.value.is_object()) {
    refuse_value(place, fmt::format("an object with {}", fmt::join(keys, ", ")));
    return false;
  }
  for (const auto& [key, value] : place.value.items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    refuse(place.path, fmt::format("does not know the key {}; expected {}", shown(json(key)),
                                   fmt::join(keys, ", ")));
    return false;
  }
  return true;
}

std::optional<JsonPlace> JsonValues::member(const JsonPlace& object, std::string_view key) {
  const auto found = object.value.find(std::string(key));
  if (found == object.value.end()) return std::nullopt;
  return JsonPlace{*found, path_of(object.path, key)};
}

std::optional<JsonPlace> JsonValues::required(const JsonPlace& object, std::string_view key,
                                              std::string_view expected) {
  auto found = member(object, key);
  if (!found) {
    refuse(path_of(object.path, key), fmt::format("is missing; expected {}", expected));
  }
  return found;
}

std::vector<JsonPlace> JsonValues::elements(const JsonPlace& place, std::size_t most,
                                            std::string_view what) {
  std::vector<JsonPlace> elements;
  if (!place.value.is_array() || place.value.empty()) {
    refuse_value(place, fmt::format("a list of {}, at least one", what));
    return elements;
  }
  if (place.value.size() > most) {
    refuse(place.path,
           fmt::format("has {} {}; at most {} are read", place.value.size(), what, most));
    return elements;
  }
  for (const json& value : place.value) {
    elements.push_back({value, fmt::format("{}[{}]", place.path, elements.size())});
  }
  return elements;
}

std::string JsonValues::text(const JsonPlace& place, std::string_view expected) {
  if (place.value.is_string() && !place.value.get_ref<const std::string&>().empty()) {
    return place.value.get<std::string>();
  }
  refuse_value(place, expected);
  return {};
}

bool JsonValues::boolean(const JsonPlace& place) {
  if (place.value.is_boolean()) return place.value.get<bool>();
  refuse_value(place, "true or false");
  return false;
}

double JsonValues::number(const JsonPlace& place, NumberRange range, std::string_view expected) {
  const double number = place.value.is_number() ? place.value.get<double>() : 0.0;
  if (place.value.is_number() && number >= range.least && number <= range.most) return number;
  refuse_value(place, expected);
  return range.least;
}

OptionValue JsonValues::option(const JsonPlace& place, const OptionRow& row) {
  OptionValue value = std::string();
  if (place.value.is_number()) value = place.value.get<double>();
  if (place.value.is_string()) value = place.value.get<std::string>();
  if (!check_value(row, value)) refuse_value(place, expected_of(row));
  return value;
}

std::vector<double> JsonValues::numbers(const JsonPlace& place, ListLength length,
                                        NumberRange range, std::string_view expected) {
  if (!place.value.is_array() || place.value.size() < length.least ||
      place.value.size() > length.most) {
    refuse_value(place, expected);
    return {};
  }
  std::vector<double> numbers;
  for (const json& value : place.value) {
    const JsonPlace element{value, fmt::format("{}[{}]", place.path, numbers.size())};
    numbers.push_back(
        number(element, range, fmt::format("a number from {:g} to {:g}", range.least, range.most)));
  }
  return error_ ? std::vector<double>() : numbers;
}

}  // namespace relief

#include "common/scene/json/json_values.h"

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

void JsonValues::refuse_value(const JsonNode& node, std::string_view expected) {
  refuse(node.path, fmt::format("expected {}; found {}", expected, shown(node.value)));
}

bool JsonValues::object(const JsonNode& node, const std::vector<std::string_view>& keys) {
  if (!node.value.is_object()) {
    refuse_value(node, fmt::format("an object with {}", fmt::join(keys, ", ")));
    return false;
  }
  for (const auto& [key, value] : node.value.items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    refuse(node.path, fmt::format("does not know the key {}; expected {}", shown(json(key)),
                                  fmt::join(keys, ", ")));
    return false;
  }
  return true;
}

std::optional<JsonNode> JsonValues::member(const JsonNode& object, std::string_view key) {
  const auto found = object.value.find(std::string(key));
  if (found == object.value.end()) return std::nullopt;
  return JsonNode{*found, path_of(object.path, key)};
}

std::optional<JsonNode> JsonValues::required(const JsonNode& object, std::string_view key,
                                             std::string_view expected) {
  auto found = member(object, key);
  if (!found) {
    refuse(path_of(object.path, key), fmt::format("is missing; expected {}", expected));
  }
  return found;
}

std::vector<JsonNode> JsonValues::elements(const JsonNode& node, std::size_t max,
                                           std::string_view what) {
  std::vector<JsonNode> elements;
  if (!node.value.is_array() || node.value.empty()) {
    refuse_value(node, fmt::format("a list of {}, at least one", what));
    return elements;
  }
  if (node.value.size() > max) {
    refuse(node.path, fmt::format("has {} {}; at most {} are read", node.value.size(), what, max));
    return elements;
  }
  for (const json& value : node.value) {
    elements.push_back({value, fmt::format("{}[{}]", node.path, elements.size())});
  }
  return elements;
}

std::string JsonValues::text(const JsonNode& node, std::string_view expected) {
  if (node.value.is_string() && !node.value.get_ref<const std::string&>().empty()) {
    return node.value.get<std::string>();
  }
  refuse_value(node, expected);
  return {};
}

bool JsonValues::boolean(const JsonNode& node) {
  if (node.value.is_boolean()) return node.value.get<bool>();
  refuse_value(node, "true or false");
  return false;
}

double JsonValues::number(const JsonNode& node, NumberRange range, std::string_view expected) {
  const double number = node.value.is_number() ? node.value.get<double>() : 0.0;
  if (node.value.is_number() && number >= range.min && number <= range.max) return number;
  refuse_value(node, expected);
  return range.min;
}

OptionValue JsonValues::option(const JsonNode& node, const OptionRow& row) {
  OptionValue value = std::string();
  if (node.value.is_number()) value = node.value.get<double>();
  if (node.value.is_string()) value = node.value.get<std::string>();
  // A text that can be a number may be written as one.
  if (node.value.is_number() && row.kind == OptionKind::Text && row.accepts_text != nullptr)
    value = fmt::format("{}", node.value.get<double>());
  if (!check_value(row, value)) refuse_value(node, expected_of(row));
  return value;
}

std::vector<double> JsonValues::numbers(const JsonNode& node, ListLength length, NumberRange range,
                                        std::string_view expected) {
  if (!node.value.is_array() || node.value.size() < length.min || node.value.size() > length.max) {
    refuse_value(node, expected);
    return {};
  }
  std::vector<double> numbers;
  for (const json& value : node.value) {
    const JsonNode element{value, fmt::format("{}[{}]", node.path, numbers.size())};
    numbers.push_back(
        number(element, range, fmt::format("a number from {:g} to {:g}", range.min, range.max)));
  }
  return error_ ? std::vector<double>() : numbers;
}

}  // namespace relief

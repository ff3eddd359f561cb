#include "common/scene/option.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace relief {
namespace {

std::string text_of(const OptionValue& value) {
  if (const auto* const name = std::get_if<std::string>(&value)) return *name;
  return fmt::format("{:g}", std::get<double>(value));
}

bool accepts(const OptionRow& row, const OptionValue& value) {
  if (row.kind == OptionKind::Choice) {
    const auto* const name = std::get_if<std::string>(&value);
    return name != nullptr &&
           std::find(row.choices.begin(), row.choices.end(), *name) != row.choices.end();
  }
  if (row.kind == OptionKind::Text) {
    const auto* const text = std::get_if<std::string>(&value);
    return text != nullptr && !text->empty() &&
           (row.accepts_text == nullptr || row.accepts_text(*text));
  }
  const double* const number = std::get_if<double>(&value);
  if (number == nullptr || !(*number >= row.range.min && *number <= row.range.max)) return false;
  return row.kind == OptionKind::Number || *number == std::floor(*number);
}

}  // namespace

std::string expected_of(const OptionRow& row) {
  if (row.kind == OptionKind::Choice) return fmt::format("{}", fmt::join(row.choices, ", "));
  if (row.kind == OptionKind::Text)
    return row.expected_text.empty() ? "a name or a file" : row.expected_text;
  return fmt::format("a {} from {:g} to {:g}",
                     row.kind == OptionKind::Integer ? "whole number" : "number", row.range.min,
                     row.range.max);
}

Status check_value(const OptionRow& row, const OptionValue& value) {
  if (accepts(row, value)) return {};
  return make_error("expected {}; found {}", expected_of(row), text_of(value));
}

Result<OptionValue> parse_value(const OptionRow& row, std::string_view text) {
  OptionValue value = std::string(text);
  if (row.kind == OptionKind::Integer || row.kind == OptionKind::Number) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size()) value = number;
  }
  RELIEF_TRY(check_value(row, value));
  return value;
}

OptionValues overlay_options(OptionValues base, const OptionValues& over) {
  for (const auto& [key, value] : over) base.insert_or_assign(key, value);
  return base;
}

}  // namespace relief

// An option of an engine, for the command line, scene files and overrides.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/error.h"
#include "common/scene/choices.h"

namespace relief {

/// A number, or the name of a choice, or a text.
using OptionValue = std::variant<double, std::string>;

/// Values by key, as the command line and scene files give them. A value that is not given has no
/// entry.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

enum class OptionKind : std::uint8_t { Integer, Number, Choice, Text };

/// The values that an option accepts, and the text of its help.
struct OptionRow {
  std::string key = {};  ///< the option without its dashes, and the key in a scene file
  OptionKind kind = OptionKind::Number;
  NumberChoice range{0.0, 0.0};           ///< of Integer and Number, both ends included
  std::vector<std::string> choices = {};  ///< of Choice
  std::string placeholder = {};   ///< in `--help`: "N", "MS"; empty for Choice, which lists them
  std::string help = {};          ///< its effect and its unit: a sentence without a period
  std::string default_text = {};  ///< "2", "4 with cells, else 0"; empty: none
  /// Of Text: a value with this extension names a file, in a scene relative to the scene's folder.
  std::string file_extension = {};
  bool is_of_model = false;  ///< a model of a scene can have a value of its own, too
  /// Of Text: whether it accepts a text that is not empty; null: any.
  bool (*accepts_text)(std::string_view) = nullptr;
  std::string expected_text = {};  ///< then what it accepts, for messages
};

/// The engines that a scene may name, and their options. The renderer derives this from its
/// registry. Keys are unique.
struct EngineKeys {
  std::vector<std::string> engines = {};
  std::vector<OptionRow> options = {};
};

/// Returns the accepted values: "a whole number from 1 to 64", "a number from 1 to 4", "ewa,
/// circular".
[[nodiscard]] std::string expected_of(const OptionRow& row);

/// Fails unless the option accepts the value: "expected a number from 1 to 4; found 7".
Status check_value(const OptionRow& row, const OptionValue& value);

/// The value that a text on the command line stands for. Fails as check_value does.
Result<OptionValue> parse_value(const OptionRow& row, std::string_view text);

/// Returns the values of `base`, overridden by those that `over` has.
[[nodiscard]] OptionValues overlay_options(OptionValues base, const OptionValues& over);

}  // namespace relief

// Typed values from a JSON tree, with their paths for messages. Not a public header: it needs
// nlohmann::json.
#pragma once

#include <glm/vec3.hpp>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/scene/choices.h"
#include "common/scene/option.h"

namespace relief {

/// A value and its path in the file, such as "views[3].orbit"; the path of the root is empty.
struct JsonNode {
  const nlohmann::json& value;
  std::string path;
};

/// Limits of the number of values in a list.
struct ListLength {
  std::size_t min = 0;
  std::size_t max = 0;
};

/// A range of numbers, both ends included.
struct NumberRange {
  double min = 0.0;
  double max = 0.0;
};

/// Reads typed values from a tree and keeps the first error. After an error it returns defaults, so
/// that a reader checks error() only once, at its end.
class JsonValues {
 public:
  /// `file` begins every message.
  explicit JsonValues(std::string file) : file_(std::move(file)) {}

  /// Returns the first error, if there was one.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  /// Records an error at a path: "FILE: PATH: CLAUSE".
  void refuse(const std::string& path, std::string_view clause);
  /// Records a wrong value: "FILE: PATH: expected EXPECTED; found VALUE".
  void refuse_value(const JsonNode& node, std::string_view expected);

  /// Checks that it is an object with no other keys than these.
  bool object(const JsonNode& node, const std::vector<std::string_view>& keys);
  /// Returns the value of a key, if the object has it.
  [[nodiscard]] static std::optional<JsonNode> member(const JsonNode& object, std::string_view key);
  /// Returns the value of a required key.
  std::optional<JsonNode> required(const JsonNode& object, std::string_view key,
                                   std::string_view expected);
  /// Returns the elements of an array of 1 to `max`; `what` names them ("views").
  std::vector<JsonNode> elements(const JsonNode& node, std::size_t max, std::string_view what);

  std::string text(const JsonNode& node, std::string_view expected);
  double number(const JsonNode& node, NumberRange range, std::string_view expected);
  bool boolean(const JsonNode& node);
  /// Returns a list of numbers in a range; empty after an error.
  std::vector<double> numbers(const JsonNode& node, ListLength length, NumberRange range,
                              std::string_view expected);

  /// Returns the value of an option, checked against its row.
  OptionValue option(const JsonNode& node, const OptionRow& row);

  /// Returns the value that a table has for a name.
  template <class T, std::size_t N>
  T choice(const JsonNode& node, const std::array<Named<T>, N>& table) {
    if (node.value.is_string()) {
      if (const auto found = find_named(table, node.value.get_ref<const std::string&>()))
        return *found;
    }
    refuse_value(node, list_names(table, ", "));
    return table.front().value;
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

}  // namespace relief

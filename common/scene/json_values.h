// Typed values from a JSON tree, each with its place. Not a public header: it needs nlohmann::json.
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

/// A value and where it stands, as in "views[3].orbit"; the path of the whole file is empty.
struct JsonPlace {
  const nlohmann::json& value;
  std::string path;
};

/// How many numbers a list has.
struct ListLength {
  std::size_t least = 0;
  std::size_t most = 0;
};

/// Inclusive.
struct NumberRange {
  double least = 0.0;
  double most = 0.0;
};

/// Takes values out of a tree and remembers the first that is not what it should be; from then on
/// all it returns are defaults. Thus a reader reads on and asks once, at its end.
class JsonValues {
 public:
  /// `file` begins every sentence.
  explicit JsonValues(std::string file) : file_(std::move(file)) {}

  /// What was wrong first, if anything was.
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  /// Remembers that something is wrong at a path: "FILE: PATH: CLAUSE".
  void refuse(const std::string& path, std::string_view clause);
  /// Remembers that a value is wrong: "FILE: PATH: expected EXPECTED; found VALUE".
  void refuse_value(const JsonPlace& place, std::string_view expected);

  /// Whether it is an object with no other keys than these.
  bool object(const JsonPlace& place, const std::vector<std::string_view>& keys);
  /// The value of a key of an object, if it has it.
  [[nodiscard]] static std::optional<JsonPlace> member(const JsonPlace& object,
                                                       std::string_view key);
  /// The value of a key that must be there.
  std::optional<JsonPlace> required(const JsonPlace& object, std::string_view key,
                                    std::string_view expected);
  /// The elements of an array of 1 to `most`; `what` names them ("views").
  std::vector<JsonPlace> elements(const JsonPlace& place, std::size_t most, std::string_view what);

  std::string text(const JsonPlace& place, std::string_view expected);
  double number(const JsonPlace& place, NumberRange range, std::string_view expected);
  bool boolean(const JsonPlace& place);
  /// A list of numbers in a range; empty where it isn't.
  std::vector<double> numbers(const JsonPlace& place, ListLength length, NumberRange range,
                              std::string_view expected);

  /// The value of an option. A value that its row does not accept is wrong.
  OptionValue option(const JsonPlace& place, const OptionRow& row);

  /// The value that a table has for a name.
  template <class T, std::size_t N>
  T choice(const JsonPlace& place, const std::array<Named<T>, N>& table) {
    if (place.value.is_string()) {
      if (const auto found = find_named(table, place.value.get_ref<const std::string&>()))
        return *found;
    }
    refuse_value(place, list_names(table, ", "));
    return table.front().value;
  }

 private:
  std::string file_;
  std::optional<Error> error_;
};

}  // namespace relief

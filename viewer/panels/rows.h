// Rows of the side panel: a label, and a widget that fills the rest of the line.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/choices.h"

namespace relief {

/// Begins a row: the next widget is as wide as the panel has room beside the label. `help` is shown
/// over the label.
void begin_row(const char* label, const char* help = nullptr);

/// A number that a user may leave to its default.
struct NumberRow {
  const char* label;
  const char* help;
  NumberChoice range;
  double usual;        ///< the value in force if none is chosen
  const char* format;  ///< of printf, for a double
  bool logarithmic = false;
};

/// Shows a slider. A right click takes the choice back. Returns whether `value` has changed.
bool number_row(const NumberRow& row, std::optional<double>& value);

/// Shows a list to choose from. Returns the index that was chosen, if it is another one.
std::optional<std::size_t> choice_row(const char* label, const char* help,
                                      const std::vector<std::string>& choices,
                                      std::optional<std::size_t> current);

/// Shows a colour, linear. Returns whether it has changed.
bool colour_row(const char* label, const char* help, glm::vec3& colour);

/// Text that is less important than others.
void show_faint(const char* text);
void show_faint_wrapped(const char* text);

/// A sentence over the last widget while the cursor rests on it.
void help_for_last(const char* text);

/// Returns a name as a text of its own: "onepass" is "Onepass".
[[nodiscard]] std::string capitalised(std::string_view name);

}  // namespace relief

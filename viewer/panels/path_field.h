// A field for a path, with how it can go on below it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "viewer/panels/panel_state.h"

namespace relief {

struct PathFieldStyle {
  const char* id;                                             ///< of Dear ImGui
  const char* hint;                                           ///< shown while it is empty
  std::function<bool(const std::filesystem::path&)> accepts;  ///< files that are listed
};

/// Shows the field. Tab goes on as far as all listed paths agree; Return or a click takes a path.
/// Returns it, once.
std::optional<std::filesystem::path> show_path_field(const PathFieldStyle& style, PathField& field);

/// Empties the field.
void clear(PathField& field);

}  // namespace relief

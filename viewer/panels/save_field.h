// A field for the name of a file that is to be written.
#pragma once

#include <filesystem>
#include <string>

#include "viewer/panels/panel_state.h"

namespace relief {

/// Shows the field; `offered` is what it holds until the user types something else. A name without
/// a folder is in that of the first open file, which the field's help says.
void show_save_field(const char* id, const std::string& offered, const Session& session,
                     SaveField& field);

/// Puts what is offered into the field, unless the user has typed something else.
void offer(const std::string& offered, SaveField& field);

/// The path that the field names.
[[nodiscard]] std::filesystem::path path_in(const SaveField& field, const Session& session);

/// Returns the first open file's name without its extensions and with an ending: "dragon-1.png".
[[nodiscard]] std::string name_beside(const Session& session, const std::string& ending);

}  // namespace relief

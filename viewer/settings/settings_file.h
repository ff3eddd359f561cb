// Where preferences are kept.
#pragma once

#include <filesystem>
#include <optional>

#include "common/error.h"
#include "viewer/settings/preferences.h"

namespace relief {

/// Returns the file of the user's settings: relief/viewer.json in `config_home` ($XDG_CONFIG_HOME;
/// null, empty or relative: as the XDG base directory specification says, .config in `home`). None
/// without either.
[[nodiscard]] std::optional<std::filesystem::path> settings_path(const char* config_home,
                                                                 const char* home);

/// Returns the same for the process's environment.
[[nodiscard]] std::optional<std::filesystem::path> settings_path();

/// Reads preferences; those that a first run has if there is no file. The file is not trusted:
/// fails, with one sentence, if it is anything but settings.
Result<Preferences> load_preferences(const std::filesystem::path& path);

/// Writes them atomically. Makes the folders that are missing.
Status save_preferences(const std::filesystem::path& path, const Preferences& preferences);

}  // namespace relief

// Bookmarks in the settings' file. Not a public header: it needs nlohmann::json.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "common/scene/json/json_values.h"
#include "viewer/navigation/file_bookmarks.h"

namespace relief {

inline constexpr std::size_t kMostBookmarksOfAFile = 200;

/// Reads them. Keys of later versions are ignored; cameras that can't be shown, and files whose
/// paths are not absolute, are left out.
std::vector<FileBookmarks> read_bookmarks(JsonValues& values, const JsonNode& node);

/// Returns them as JSON, at most kMostBookmarksOfAFile of each file. Paths and names that are not
/// UTF-8 are left out.
[[nodiscard]] nlohmann::json json_of(const std::vector<FileBookmarks>& all);

}  // namespace relief

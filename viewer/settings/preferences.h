// What the window remembers from one run to the next.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/scene/choices.h"
#include "common/scene/material.h"
#include "viewer/navigation/drag.h"
#include "viewer/navigation/file_bookmarks.h"

namespace relief {

inline constexpr std::size_t kMostRecentFiles = 12;
inline constexpr std::size_t kMostRecentEnvironments = 6;

/// Times of a moving frame that can be asked for, milliseconds.
inline constexpr NumberChoice kTargetMs{5.0, 1000.0};

/// Sides of a window, in pixels of a screen whose content scale is 1.
inline constexpr NumberChoice kWindowSides{200.0, 16384.0};

inline constexpr std::array<Named<OrbitStyle>, 2> kOrbitStyles{
    {{"turntable", OrbitStyle::Turntable}, {"trackball", OrbitStyle::Trackball}}};

/// No look is among them: a scan's first picture is that of `relief render`.
struct Preferences {
  glm::ivec2 window{1280, 800};  ///< its size on a screen whose content scale is 1
  bool shows_panels = true;
  std::map<std::string, bool, std::less<>> sections;       ///< open or not, by title
  std::vector<std::filesystem::path> recent_files;         ///< absolute, the latest first
  std::vector<std::filesystem::path> recent_environments;  ///< likewise
  std::vector<FileBookmarks> bookmarks;                    ///< of the file used last first
  double target_ms = 33.0;
  OrbitStyle orbit_style = OrbitStyle::Turntable;
  MaterialConstants material;  ///< what a mirror or a glass begins with once it is chosen

  bool operator==(const Preferences&) const = default;
};

/// Puts a path, made absolute, first in a list of at most `most` different ones.
void remember(std::vector<std::filesystem::path>& list, const std::filesystem::path& path,
              std::size_t most);

/// Reads preferences from JSON. The text is not trusted: fails, with one sentence that begins with
/// `name`, if a value is of the wrong type or out of range. Keys of later versions are ignored, and
/// paths that are not absolute are left out.
Result<Preferences> parse_preferences(std::string_view text, const std::string& name);

/// Returns them as JSON. Paths that are not UTF-8 are left out, which JSON has no way to hold.
[[nodiscard]] std::string preferences_text(const Preferences& preferences);

}  // namespace relief

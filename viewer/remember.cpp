#include "viewer/remember.h"

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "viewer/settings/paths.h"
#include "viewer/settings/settings_file.h"

namespace relief {
namespace {

/// A minimised window has no size; what it had before stays.
void note_window(glm::ivec2 pixels, double scale, Preferences& preferences) {
  const glm::ivec2 size(std::lround(pixels.x / scale), std::lround(pixels.y / scale));
  const auto fits = [](int side) { return side >= kWindowSides.min && side <= kWindowSides.max; };
  if (fits(size.x) && fits(size.y)) preferences.window = size;
}

}  // namespace

void apply_preferences(Preferences preferences, Session& session) {
  session.shows_panels = preferences.shows_panels;
  session.target_ms = preferences.target_ms;
  session.navigator.set_orbit_style(preferences.orbit_style);
  session.preferences = std::move(preferences);
}

void follow_bookmarks(Session& session) {
  const auto& files = session.document.files();
  const std::filesystem::path now =
      files.empty() ? std::filesystem::path() : whole_path(files.front());
  std::vector<FileBookmarks>& kept = session.preferences.bookmarks;
  if (!session.bookmarked.empty())
    keep_bookmarks(kept, session.bookmarked, session.bookmarks.list());
  if (now == session.bookmarked) return;
  session.bookmarks.assign(bookmarks_of(kept, now));
  session.bookmarked = now;
}

Status remember_files(Session& session, glm::ivec2 window) {
  // The first one opened is the first one listed.
  const auto& files = session.document.files();
  for (auto file = files.rbegin(); file != files.rend(); ++file)
    remember(session.preferences.recent_files, *file, kMostRecentFiles);
  return remember_settings(session, window);
}

Status remember_settings(Session& session, glm::ivec2 window) {
  const auto path = settings_path();
  if (!path) return {};
  Preferences& preferences = session.preferences;
  if (!session.wants_full_screen) note_window(window, session.scale, preferences);
  preferences.shows_panels = session.shows_panels;
  preferences.orbit_style = session.navigator.orbit_style();
  follow_bookmarks(session);
  return save_preferences(*path, preferences);
}

}  // namespace relief

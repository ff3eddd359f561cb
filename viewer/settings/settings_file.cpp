#include "viewer/settings/settings_file.h"

#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "common/io/file.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Twelve paths of the longest kind and more; a larger file is something else.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20U;

}  // namespace

std::optional<fs::path> settings_path(const char* config_home, const char* home) {
  fs::path folder = config_home == nullptr ? fs::path() : fs::path(config_home);
  if (!folder.is_absolute()) {
    if (home == nullptr || !fs::path(home).is_absolute()) return std::nullopt;
    folder = fs::path(home) / ".config";
  }
  return folder / "relief" / "viewer.json";
}

std::optional<fs::path> settings_path() {
  // Read before there is a second thread that could change them.
  return settings_path(std::getenv("XDG_CONFIG_HOME"), std::getenv("HOME"));  // NOLINT
}

Result<Preferences> load_preferences(const fs::path& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (status.type() == fs::file_type::not_found) return Preferences();
  // A named pipe would be waited for.
  if (failed || !fs::is_regular_file(status))
    return make_error("{}: is no file of settings", path.string());
  const std::uintmax_t bytes = fs::file_size(path, failed);
  if (!failed && bytes > kMostBytes)
    return make_error("{}: has {} bytes, too many for settings", path.string(), bytes);
  RELIEF_TRY_ASSIGN(const auto content, read_file(path));
  return parse_preferences({reinterpret_cast<const char*>(content.data()), content.size()},
                           path.string());
}

Status save_preferences(const fs::path& path, const Preferences& preferences) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  if (failed) {
    return make_error("{}: the folder of the settings can't be made ({})",
                      path.parent_path().string(), failed.message());
  }
  const std::string text = preferences_text(preferences);
  return write_file_atomically(path, std::as_bytes(std::span(text)));
}

}  // namespace relief

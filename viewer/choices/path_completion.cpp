#include "viewer/choices/path_completion.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "common/io/extension.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

std::string home() {
  const char* const found = std::getenv("HOME");  // NOLINT: nothing changes it
  return found == nullptr ? std::string() : std::string(found);
}

}  // namespace

fs::path typed_path(std::string_view typed) {
  if (typed == "~" || typed.starts_with("~/")) {
    if (const std::string folder = home(); !folder.empty())
      return folder + std::string(typed.substr(1));
  }
  return typed;
}

std::vector<std::string> complete_path(std::string_view typed,
                                       const std::function<bool(const fs::path&)>& accepts,
                                       std::size_t most) {
  const std::size_t slash = typed.rfind('/');
  const std::string before(slash == std::string_view::npos ? "" : typed.substr(0, slash + 1));
  const std::string_view start = typed.substr(before.size());
  std::vector<std::string> found;
  std::error_code failed;
  fs::directory_iterator entry(before.empty() ? fs::path(".") : typed_path(before), failed);
  for (std::size_t seen = 0; !failed && entry != fs::directory_iterator() && seen < kMostEntries;
       entry.increment(failed), ++seen) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(start) || (name.starts_with('.') && !start.starts_with('.'))) continue;
    std::error_code gone;
    const bool is_folder = entry->is_directory(gone);
    if (is_folder || accepts(entry->path()))
      found.push_back(before + name + (is_folder ? "/" : ""));
  }
  std::sort(found.begin(), found.end());
  if (found.size() > most) found.resize(most);
  return found;
}

std::string common_start(const std::vector<std::string>& texts) {
  if (texts.empty()) return {};
  std::string start = texts.front();
  for (const std::string& text : texts) {
    const auto [end, ignored] = std::mismatch(start.begin(), start.end(), text.begin(), text.end());
    start.erase(end, start.end());
  }
  return start;
}

bool has_extension(const fs::path& path, const std::vector<std::string>& extensions) {
  return std::find(extensions.begin(), extensions.end(), lower_extension(path)) != extensions.end();
}

}  // namespace relief

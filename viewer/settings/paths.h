// Paths in the settings' file.
#pragma once

#include <filesystem>
#include <string>

namespace relief {

inline constexpr std::size_t kLongestPath = 4096;  // PATH_MAX of Linux

/// Whether a text, which is not trusted, is an absolute path.
[[nodiscard]] inline bool is_absolute_path(const std::string& text) {
  // With a zero byte it would be another file's name to the operating system.
  return text.size() <= kLongestPath && text.find('\0') == std::string::npos &&
         std::filesystem::path(text).is_absolute();
}

}  // namespace relief

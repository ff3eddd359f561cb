// Paths in the settings' file.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace relief {

inline constexpr std::size_t kLongestPath = 4096;  // PATH_MAX of Linux

/// Whether a text, which is not trusted, is an absolute path.
[[nodiscard]] inline bool is_absolute_path(const std::string& text) {
  // With a zero byte it would be another file's name to the operating system.
  return text.size() <= kLongestPath && text.find('\0') == std::string::npos &&
         std::filesystem::path(text).is_absolute();
}

/// Returns a path as the settings keep it: absolute and without detours. Empty if the working
/// directory is gone.
[[nodiscard]] inline std::filesystem::path whole_path(const std::filesystem::path& path) {
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(path, failed).lexically_normal();
  return failed ? std::filesystem::path() : whole;
}

}  // namespace relief

// A folder for files that nobody else sees.
#pragma once

#include <filesystem>
#include <string_view>

#include "common/error.h"

namespace relief {

/// A new folder where the system keeps temporary files. The destructor removes it with all that is
/// in it.
class TemporaryFolder {
 public:
  /// Its name begins with `prefix`.
  static Result<TemporaryFolder> make(std::string_view prefix);

  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;  ///< empty: moved away
};

}  // namespace relief

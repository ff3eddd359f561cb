#include "common/io/temporary_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>

namespace relief {

namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::make(std::string_view prefix) {
  std::error_code ignored;
  std::string folder =
      (fs::temp_directory_path(ignored) / (std::string(prefix) + "-XXXXXX")).string();
  if (::mkdtemp(folder.data()) == nullptr)
    return make_error("{}: cannot be made: {}", folder, std::generic_category().message(errno));
  return TemporaryFolder(folder);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace relief

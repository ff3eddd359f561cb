#include "cli/options/paths.h"

#include <unistd.h>

#include <system_error>

namespace relief::cli {

namespace fs = std::filesystem;

Status check_output(const fs::path& path, const std::vector<fs::path>& inputs) {
  std::error_code ignored;
  const std::string name = path.string();
  if (fs::is_directory(path, ignored)) {
    return make_error("{}: is a directory; name a file to write", name);
  }
  // Writing renames a new file over the old one, which would replace a device by a file.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    return make_error("{}: is no regular file; name a file to write", name);
  }
  for (const fs::path& input : inputs) {
    if (fs::equivalent(path, input, ignored)) {
      return make_error("{}: is also the input; name another file to write", name);
    }
  }
  const fs::path directory = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(directory, ignored)) {
    return make_error("{}: there is no directory {}; make it first", name, directory.string());
  }
  if (access(directory.c_str(), W_OK | X_OK) != 0) {
    return make_error("{}: the directory {} can't be written to", name, directory.string());
  }
  return {};
}

}  // namespace relief::cli

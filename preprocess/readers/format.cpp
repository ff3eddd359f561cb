#include "preprocess/readers/format.h"

#include <algorithm>
#include <string>

#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// The ending of the name in lower case, that of the packed file if it ends with ".gz".
std::string ending(std::filesystem::path path) {
  const auto lower = [](const std::filesystem::path& p) {
    return lower_case(p.extension().string());
  };
  if (lower(path) == ".gz") path = path.stem();
  return lower(path);
}

bool is_ply(std::string_view text) {
  return text.starts_with("ply\n") || text.starts_with("ply\r") || text.starts_with("ply ");
}

}  // namespace

Result<Reader> find_reader(const std::filesystem::path& path, std::string_view text) {
  const std::string name = ending(path);
  if (is_ply(text) || name == ".ply") return Reader{read_ply};
  return make_error(
      "{}: is not in a format that can be read: PLY, PCD, OBJ, OFF, STL or XYZ text, "
      "plain or gzipped",
      path.string());
}

}  // namespace relief

#include "preprocess/volumes/volume_source.h"

#include <algorithm>

#include "preprocess/readers/source.h"

namespace relief {

Result<MappedFile> open_beside(const VolumeSource& header, std::string_view file) {
  // A NUL would end the name where the system reads it.
  if (file.empty() || file.find('\0') != file.npos)
    return make_error("{}: names no file for its values", header.name);
  const std::filesystem::path path(file);
  if (path.is_absolute() || std::ranges::count(path, "..") != 0) {
    return make_error(
        "{}: names {} as the file of its values, which is outside the header's folder; put both "
        "into one folder and name the file without a path",
        header.name, relief::quoted(file));
  }
  auto opened = MappedFile::open(std::filesystem::path(header.name).parent_path() / path);
  if (!opened) {
    return make_error("{}: the file of its values: {}", header.name, opened.error().message);
  }
  header.progress.begin_stage("read", opened->bytes().size());
  return opened;
}

}  // namespace relief

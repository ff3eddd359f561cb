#include "preprocess/volumes/volume_source.h"

#include <algorithm>
#include <filesystem>

#include "preprocess/readers/source.h"

namespace relief {
namespace {

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

}  // namespace

Result<HeaderValues> values_of_header(const VolumeSource& header,
                                      const std::optional<std::string>& file, std::size_t end) {
  HeaderValues values;
  if (!file) {
    values.bytes = header.bytes.subspan(end);
    return values;
  }
  RELIEF_TRY_ASSIGN(values.file, open_beside(header, *file));
  values.bytes = values.file->bytes();
  return values;
}

std::span<const std::byte> last_bytes(std::span<const std::byte> bytes, std::uint64_t count) {
  return bytes.last(std::min<std::uint64_t>(count, bytes.size()));
}

}  // namespace relief

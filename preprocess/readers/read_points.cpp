#include "preprocess/read_points.h"

#include <unistd.h>

#include <new>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/file.h"
#include "preprocess/readers/format.h"
#include "preprocess/readers/gunzip.h"

namespace relief {
namespace {

/// How far a packed file may grow: half of this machine's memory. The points have to fit beside it.
std::uint64_t largest_text() {
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  const auto page_size = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return pages * page_size / 2;
}

Result<ReadResult> read_and_clean(const std::filesystem::path& path, Progress& progress) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  const std::string name = path.string();
  if (is_gzip(*bytes)) {
    bytes = gunzip(name, *bytes, largest_text(), progress);
    if (!bytes) return bytes.error();
  }
  std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  // Editors on Windows put this mark before text.
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const auto reader = find_reader(path, text);
  if (!reader) return reader.error();
  progress.begin_stage("read", text.size());
  auto points = (*reader)({name, text, progress});
  if (!points) return points.error();
  *bytes = std::vector<std::byte>();  // frees; = {} would keep the memory

  ReadResult result = clean_points(std::move(*points));
  if (result.points.positions.empty()) {
    return result.dropped_nonfinite == 0
               ? make_error("{}: holds no points", name)
               : make_error("{}: holds no points: the coordinates of all {} are NaN or infinite",
                            name, result.dropped_nonfinite);
  }
  return result;
}

}  // namespace

Result<ReadResult> read_points(const std::filesystem::path& path, Progress& progress) {
  try {
    return read_and_clean(path, progress);
  } catch (const std::bad_alloc&) {
    return make_error("{}: there is not enough memory to read it", path.string());
  } catch (const std::length_error&) {
    return make_error("{}: there is not enough memory to read it", path.string());
  }
}

}  // namespace relief

#include "preprocess/tiles/tile_job.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "common/io/file.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kJobFile = "job";

/// Temporary files of AtomicFile that a killed process left behind.
bool is_temporary(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.starts_with(".relief-") && name.ends_with(".tmp");
}

void remove_temporary(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, ignored)) {
    if (is_temporary(entry.path())) fs::remove(entry.path(), ignored);
  }
}

/// Returns whether a folder contains files that are not relief's.
bool is_foreign(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / kJobFile, error)) return false;
  const fs::directory_iterator entries(folder, error);
  return error || !std::all_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
           return is_temporary(entry.path());
         });
}

/// Removes a folder's contents, the file that identifies it last.
Status remove_contents(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().filename() == kJobFile) continue;
    fs::remove_all(entry.path(), error);
    if (error) {
      return make_error("{}: cannot be removed: {}", entry.path().string(), error.message());
    }
  }
  if (error) return make_error("{}: cannot be listed: {}", folder.string(), error.message());
  return {};
}

}  // namespace

Result<TileJob> TileJob::open(const fs::path& output, const std::string& fingerprint) {
  const fs::path folder = folder_of(output);
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) {
    return make_error("{}: cannot be made, to keep parts in: {}", folder.string(), error.message());
  }
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) {
    return make_error("{}: cannot be opened: {}", folder.string(),
                      std::generic_category().message(errno));
  }
  TileJob job(folder, lock, false);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    return make_error("{}: another relief is converting to {}", folder.string(), output.string());
  }
  const fs::path job_file = folder / kJobFile;
  if (is_foreign(folder)) {
    return make_error(
        "{}: is not a folder that relief made to keep parts in; move it, or choose another output",
        folder.string());
  }
  if (fs::exists(job_file)) {
    const auto known = read_file(job_file);
    const auto bytes = std::as_bytes(std::span(fingerprint));
    job.is_resumed_ = known && std::ranges::equal(*known, bytes);
    if (job.is_resumed_) {
      remove_temporary(folder);
      return job;
    }
    RELIEF_TRY(job.clear());
  }
  RELIEF_TRY(write_file_atomically(job_file, std::as_bytes(std::span(fingerprint))));
  return job;
}

fs::path TileJob::folder_of(const fs::path& output) {
  fs::path folder = output;
  return folder += ".parts";
}

TileJob::TileJob(TileJob&& other) noexcept
    : TileFolder(std::move(other.folder_)),
      lock_(std::exchange(other.lock_, -1)),
      is_resumed_(other.is_resumed_) {}

TileJob& TileJob::operator=(TileJob&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  std::swap(is_resumed_, other.is_resumed_);
  return *this;
}

TileJob::~TileJob() {
  if (lock_ >= 0) ::close(lock_);
}

fs::path TileFolder::survey(std::size_t tile) const {
  return folder_ / fmt::format("survey-{}", tile);
}

fs::path TileFolder::rim(std::size_t tile) const {
  return folder_ / fmt::format("rim-{}", tile);
}

fs::path TileFolder::clean(std::size_t tile) const {
  return folder_ / fmt::format("clean-{}", tile);
}

fs::path TileFolder::cosines(std::size_t tile) const {
  return folder_ / fmt::format("cosines-{}", tile);
}

fs::path TileFolder::part(std::size_t tile) const {
  return folder_ / fmt::format("part-{}.relief", tile);
}

fs::path TileFolder::part_report(std::size_t tile) const {
  return folder_ / fmt::format("report-{}", tile);
}

TileFolder TileJob::overview(unsigned level) const {
  return TileFolder(folder_ / fmt::format("overview-{}", level));
}

Status TileJob::clear() const {
  return remove_contents(folder_);
}

void TileJob::remove() const {
  std::error_code ignored;
  if (remove_contents(folder_)) fs::remove_all(folder_, ignored);
}

}  // namespace relief

#include "common/io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "common/io/standard_input.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Returns the system's message, such as "no space left on device", for the middle of a sentence.
std::string reason(int error) {
  std::string text = std::generic_category().message(error);
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') {
    text[0] = static_cast<char>(text[0] - 'A' + 'a');
  }
  return text;
}

/// Calls `transfer(done)` until `size` bytes have gone through; 0 or an errno value. A transfer of
/// nothing is the end of the file and ends the loop with `done` below `size`.
template <class Transfer>
int transfer_all(std::size_t size, std::size_t& done, const Transfer& transfer) {
  for (done = 0; done < size;) {
    const ssize_t step = transfer(done);
    if (step < 0 && errno == EINTR) continue;
    if (step < 0) return errno;
    if (step == 0) return 0;
    done += static_cast<std::size_t>(step);
  }
  return 0;
}

/// Returns `path` with links resolved, also if the file does not exist yet.
fs::path follow_links(const fs::path& path) {
  fs::path target = path;
  std::error_code ignored;
  // 40 is the kernel's own limit; a longer chain fails when it is opened.
  for (int link = 0; link < 40 && fs::is_symlink(target, ignored); ++link) {
    const fs::path next = fs::read_symlink(target, ignored);
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target;
}

constexpr int kMostUnfinished = 10000;

/// The number makes the name unique among files that the same process writes at once or that an
/// earlier process with this id left behind when it was killed.
fs::path unfinished_file(const fs::path& target, int number) {
  return target.parent_path() / fmt::format(".relief-{}-{}.tmp", ::getpid(), number);
}

}  // namespace

Result<RandomAccessFile> RandomAccessFile::open(const fs::path& path) {
  // Non-blocking, so that a pipe without a writer is refused and not waited for.
  const int descriptor = ::open(input_path(path).c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) {
    return make_error("{}: cannot be opened: {}", path.string(), reason(errno));
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) {
    const int error = errno;
    ::close(descriptor);
    return make_error("{}: cannot be opened: {}", path.string(), reason(error));
  }
  RandomAccessFile file(path, descriptor, static_cast<std::uint64_t>(status.st_size));
  if (S_ISDIR(status.st_mode)) return make_error("{}: is a directory, not a file", path.string());
  if (!S_ISREG(status.st_mode)) return make_error("{}: is not a regular file", path.string());
  return file;
}

RandomAccessFile::RandomAccessFile(fs::path path, int descriptor, std::uint64_t size)
    : path_(std::move(path)), descriptor_(descriptor), size_(size) {}

RandomAccessFile::RandomAccessFile(RandomAccessFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

RandomAccessFile& RandomAccessFile::operator=(RandomAccessFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(size_, other.size_);
  return *this;
}

RandomAccessFile::~RandomAccessFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status RandomAccessFile::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
  std::size_t done = 0;
  const int error = transfer_all(bytes.size(), done, [&](std::size_t at) {
    return ::pread(descriptor_, bytes.data() + at, bytes.size() - at,
                   static_cast<off_t>(offset + at));
  });
  if (error != 0) {
    return make_error("{}: byte {}: cannot be read: {}", path_.string(), offset + done,
                      reason(error));
  }
  if (done < bytes.size()) {
    return make_error("{}: ends at byte {}, but byte {} was expected; the file is truncated",
                      path_.string(), offset + done, offset + bytes.size() - 1);
  }
  return {};
}

Result<std::vector<std::byte>> read_file(const fs::path& path) {
  RELIEF_TRY_ASSIGN(auto file, RandomAccessFile::open(path));
  if (file.size() == 0) return make_error("{}: the file is empty", path.string());
  try {
    std::vector<std::byte> bytes(file.size());
    RELIEF_TRY(file.read_at(0, bytes));
    return bytes;
  } catch (const std::bad_alloc&) {
    return make_error(
        "{}: its {} MB do not fit into memory; free some memory, or use a machine with more",
        path.string(), file.size() >> 20U);
  }
}

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  const fs::path target = follow_links(path);
  std::error_code missing;
  const fs::file_status there = fs::status(target, missing);
  if (fs::is_directory(there) || !path.has_filename()) {
    return make_error("{}: is a directory; name a file to write to", path.string());
  }
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    return make_error("{}: is not a regular file, so it cannot be written to", path.string());
  }
  if (fs::exists(there) && ::access(target.c_str(), W_OK) != 0) {
    return make_error("{}: cannot be overwritten: {}", path.string(), reason(errno));
  }

  for (int number = 0; number < kMostUnfinished; ++number) {
    fs::path temporary = unfinished_file(target, number);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return AtomicFile(path, target, std::move(temporary), descriptor);
    if (errno == ENOENT || errno == ENOTDIR) {
      return make_error("{}: cannot be written: there is no directory {}", path.string(),
                        target.parent_path().string());
    }
    if (errno != EEXIST) {
      return make_error("{}: cannot be written: {}", path.string(), reason(errno));
    }
  }
  return make_error(
      "{}: cannot be written: {} is full of old files named .relief-*.tmp; remove them",
      path.string(), target.parent_path().string());
}

AtomicFile::AtomicFile(fs::path named, fs::path target, fs::path temporary, int descriptor)
    : named_(std::move(named)),
      target_(std::move(target)),
      temporary_(std::move(temporary)),
      descriptor_(descriptor) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : named_(std::move(other.named_)),
      target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(named_, other.named_);
  std::swap(target_, other.target_);
  std::swap(temporary_, other.temporary_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

AtomicFile::~AtomicFile() {
  discard();
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

Status AtomicFile::write(std::span<const std::byte> bytes) {
  assert(descriptor_ >= 0 && "nothing is written after commit");
  std::size_t done = 0;
  const int error = transfer_all(bytes.size(), done, [&](std::size_t at) {
    return ::write(descriptor_, bytes.data() + at, bytes.size() - at);
  });
  if (error != 0 || done < bytes.size()) {
    discard();
    return make_error("{}: cannot be written: {}", named_.string(),
                      reason(error != 0 ? error : ENOSPC));
  }
  return {};
}

Status AtomicFile::commit() {
  assert(descriptor_ >= 0 && "a file is committed once");
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0 ||
      ::rename(temporary_.c_str(), target_.c_str()) != 0) {
    const int error = errno;
    discard();
    return make_error("{}: cannot be written: {}", named_.string(), reason(error));
  }
  temporary_.clear();
  return {};
}

Status write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  RELIEF_TRY_ASSIGN(auto file, AtomicFile::create(path));
  RELIEF_TRY(file.write(bytes));
  return file.commit();
}

void remove_unfinished_files(const fs::path& path) noexcept {
  try {
    const fs::path target = follow_links(path);
    // Files are numbered from 0, and few are written at once.
    for (int number = 0; number < 64; ++number) ::unlink(unfinished_file(target, number).c_str());
  } catch (...) {  // NOLINT: the process ends, and without memory a file stays
  }
}

Status move_into_place(const fs::path& file, const fs::path& path) {
  if (::rename(file.c_str(), follow_links(path).c_str()) != 0) {
    return make_error("{}: cannot be written: {}; what was to be written is {}", path.string(),
                      reason(errno), file.string());
  }
  return {};
}

}  // namespace relief

#include "common/io/mapped_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "common/io/file.h"

namespace relief {

Result<MappedFile> MappedFile::open(const std::filesystem::path& path) {
  const auto file = RandomAccessFile::open(path);
  if (!file) return file.error();
  if (file->size() == 0) return make_error("{}: the file is empty", path.string());
  void* const memory = ::mmap(nullptr, file->size(), PROT_READ, MAP_PRIVATE, file->descriptor(), 0);
  if (memory == MAP_FAILED) {
    return make_error("{}: cannot be mapped: {}", path.string(),
                      std::generic_category().message(errno));
  }
  ::madvise(memory, file->size(), MADV_SEQUENTIAL);
  return MappedFile({static_cast<const std::byte*>(memory), file->size()});
}

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
  std::swap(bytes_, other.bytes_);
  return *this;
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::release_before(std::size_t offset) const {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t size = std::min(offset, bytes_.size()) / page * page;
  if (size > 0) ::madvise(const_cast<std::byte*>(bytes_.data()), size, MADV_DONTNEED);
}

}  // namespace relief

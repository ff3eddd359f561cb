// Memory-mapped files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "common/error.h"

namespace relief {

/// A whole file, mapped for reading. The process dies if another one truncates the file meanwhile,
/// as with every mapped file.
class MappedFile {
 public:
  /// Fails on a missing, unreadable or empty file and on a directory.
  static Result<MappedFile> open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  /// Releases the memory of the bytes before `offset`; a later access reads them from disk again.
  void release_before(std::size_t offset) const;

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace relief

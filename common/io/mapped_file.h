// A file as memory, of which only what is being read need be there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "common/error.h"

namespace relief {

/// A whole file, mapped for reading. Whoever truncates it meanwhile ends the process, as with every
/// mapped file.
class MappedFile {
 public:
  /// Fails with one sentence on a missing file, a directory, an unreadable or empty one.
  static Result<MappedFile> open(const std::filesystem::path& path);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  /// Lets memory go that holds the bytes before `offset`; they are read anew when they are asked
  /// for again.
  void release_before(std::size_t offset) const;

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace relief

// Reads files, and writes them atomically: never leaves a partial file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"

namespace relief {

/// Reads a whole file. Fails on a missing, unreadable or empty file and on a directory.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

/// Writes `bytes` to a temporary file in the same directory and renames it to `path`. On any
/// failure (no such directory, `path` is a directory, disk full) the temporary file is removed, an
/// existing `path` stays unchanged, and the error gives the reason.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Renames a complete file to `path`, on the same disk. Follows a symbolic link.
Status move_into_place(const std::filesystem::path& file, const std::filesystem::path& path);

/// Writes a file atomically in pieces, for data too large for memory: create, write, commit.
/// Without a commit the destructor removes the temporary file, so that an early return leaves
/// nothing behind. Follows a symbolic link; refuses a device or a directory.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& path);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// Appends `bytes`.
  Status write(std::span<const std::byte> bytes);
  /// Renames the file to its path. Nothing may be written afterwards.
  Status commit();

 private:
  AtomicFile(std::filesystem::path named, std::filesystem::path target,
             std::filesystem::path temporary, int descriptor);
  void discard() noexcept;

  std::filesystem::path named_;      ///< the caller's path, for messages
  std::filesystem::path target_;     ///< with links resolved
  std::filesystem::path temporary_;  ///< beside target_; empty once committed or moved from
  int descriptor_ = -1;
};

/// Removes the unfinished files of this process that would become `path` or a file beside it. For a
/// process that is about to end while another thread writes.
void remove_unfinished_files(const std::filesystem::path& path) noexcept;

/// A file open for reading at any offset, from any thread.
class RandomAccessFile {
 public:
  static Result<RandomAccessFile> open(const std::filesystem::path& path);

  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;
  ~RandomAccessFile();

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Returns the file descriptor, which the object keeps owning.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Fills `bytes` from `offset`. Fails if the file ends earlier. Thread-safe.
  Status read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  RandomAccessFile(std::filesystem::path path, int descriptor, std::uint64_t size);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace relief

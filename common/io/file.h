// Files as bytes: reading with one clear sentence on failure, writing that never leaves half a
// file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/error.h"

namespace relief {

/// Reads a whole file. Says what is wrong with a missing file, a directory, an unreadable or empty
/// one.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& path);

/// Writes `bytes` to a temporary file in the same directory and renames it to `path`. On any
/// failure (no such directory, `path` is a directory, disk full) the temporary file is removed, an
/// older `path` stays as it was and one sentence says what happened.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Renames a file that is whole to `path`, on the same disk; a symbolic link is followed.
Status move_into_place(const std::filesystem::path& file, const std::filesystem::path& path);

/// The same in pieces, for what should not be held in memory as a whole: create, write, commit.
/// Without a commit the destructor removes the temporary file, so that an early return leaves
/// nothing behind. A symbolic link is followed; a device or a directory is refused.
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
  /// Puts the file in its place. Nothing may be written afterwards.
  Status commit();

 private:
  AtomicFile(std::filesystem::path named, std::filesystem::path target,
             std::filesystem::path temporary, int descriptor);
  void discard() noexcept;

  std::filesystem::path named_;      ///< as the caller named it, for messages
  std::filesystem::path target_;     ///< where links lead
  std::filesystem::path temporary_;  ///< beside target_; empty once committed or moved from
  int descriptor_ = -1;
};

/// A file open for reading at any place, from any thread.
class RandomAccessFile {
 public:
  static Result<RandomAccessFile> open(const std::filesystem::path& path);

  RandomAccessFile(RandomAccessFile&& other) noexcept;
  RandomAccessFile& operator=(RandomAccessFile&& other) noexcept;
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;
  ~RandomAccessFile();

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Of the operating system; stays the file's own.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Fills `bytes` from `offset`. Fails if the file ends before. Thread-safe.
  Status read_at(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  RandomAccessFile(std::filesystem::path path, int descriptor, std::uint64_t size);

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace relief

// A file written from front to back by one of the exporters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/io/bytes.h"
#include "common/io/file.h"
#include "common/progress.h"

namespace relief {

/// Collects bytes and writes them in pieces. The first failure is kept for `finish`; what is
/// appended after it is lost, so that only loops need to look at `good`.
class ExportFile {
 public:
  /// `records`: points and triangles to come, for the progress.
  static Result<ExportFile> create(const std::filesystem::path& path, std::uint64_t records,
                                   Progress& progress);

  void text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
  /// Little-endian.
  template <class... Numbers>
  void numbers(Numbers... numbers) {
    (append_number(buffer_, numbers), ...);
  }

  /// A point or triangle is written. False: stop, something failed.
  [[nodiscard]] bool end_record() {
    ++records_;
    return buffer_.size() < kPiece || flush();
  }

  /// Puts the file in its place.
  Status finish();

 private:
  /// Large enough that a write costs nothing beside it.
  static constexpr std::size_t kPiece = std::size_t{1} << 20U;

  ExportFile(AtomicFile file, Progress& progress) : file_(std::move(file)), progress_(&progress) {}
  bool flush();

  AtomicFile file_;
  Progress* progress_;
  std::vector<std::byte> buffer_;
  std::uint64_t records_ = 0;  ///< since the progress was told
  Status status_;
};

}  // namespace relief

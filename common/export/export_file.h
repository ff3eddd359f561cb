// The output file of an exporter, written front to back.
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

/// Collects bytes and writes them in pieces. Keeps the first failure for `finish` and ignores
/// everything appended after it, so that only loops need to check for failure.
class ExportFile {
 public:
  /// `records`: number of points and triangles to write, for the progress.
  static Result<ExportFile> create(const std::filesystem::path& path, std::uint64_t records,
                                   Progress& progress);

  void text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  }
  /// Appends numbers, little-endian.
  template <class... Numbers>
  void numbers(Numbers... numbers) {
    (append_number(buffer_, numbers), ...);
  }

  /// Ends a point or triangle. Returns false after a failure: stop then.
  [[nodiscard]] bool end_record() {
    ++records_;
    return buffer_.size() < kPiece || flush();
  }

  /// Moves the complete file to its path.
  Status finish();

 private:
  /// Large enough that a write costs nothing beside it.
  static constexpr std::size_t kPiece = std::size_t{1} << 20U;

  ExportFile(AtomicFile file, Progress& progress) : file_(std::move(file)), progress_(&progress) {}
  bool flush();

  AtomicFile file_;
  Progress* progress_;
  std::vector<std::byte> buffer_;
  std::uint64_t records_ = 0;  ///< since the last progress report
  Status status_;
};

}  // namespace relief

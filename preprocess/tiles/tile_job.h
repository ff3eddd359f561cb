// The folder in which a conversion in tiles keeps its finished parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "common/error.h"

namespace relief {

/// Paths of the finished parts of a conversion.
class TileFolder {
 public:
  explicit TileFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path layout() const { return folder_ / "layout"; }
  [[nodiscard]] std::filesystem::path turns() const { return folder_ / "turns"; }
  [[nodiscard]] std::filesystem::path clean(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path survey(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path rim(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path cosines(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part_report(std::size_t tile) const;

 protected:
  std::filesystem::path folder_;
};

/// A conversion's own folder, beside its output and on the same disk. It remains if the conversion
/// ends early, so that a later run can continue. A lock keeps other processes out.
class TileJob : public TileFolder {
 public:
  /// Opens or makes the folder of the conversion to `output`. `fingerprint` identifies input and
  /// options: files of a different conversion are removed first. Fails with one sentence if the
  /// folder is not a conversion's, is in use by another process, or is not writable.
  static Result<TileJob> open(const std::filesystem::path& output, const std::string& fingerprint);

  /// Returns the folder of the conversion to `output`.
  [[nodiscard]] static std::filesystem::path folder_of(const std::filesystem::path& output);

  TileJob(TileJob&& other) noexcept;
  TileJob& operator=(TileJob&& other) noexcept;
  TileJob(const TileJob&) = delete;
  TileJob& operator=(const TileJob&) = delete;
  ~TileJob();

  /// Returns whether an earlier run left results.
  [[nodiscard]] bool is_resumed() const { return is_resumed_; }

  /// Returns the path of the complete file, before it is moved to the output.
  [[nodiscard]] std::filesystem::path whole() const { return folder_ / "whole.relief"; }
  /// Returns the subfolder for the tiles of a coarser level, 1 or more.
  [[nodiscard]] TileFolder overview(unsigned level) const;

  /// Removes everything but the fingerprint, to start again.
  Status clear() const;
  /// Removes the folder, at the end.
  void remove() const;

 private:
  TileJob(std::filesystem::path folder, int lock, bool is_resumed)
      : TileFolder(std::move(folder)), lock_(lock), is_resumed_(is_resumed) {}

  int lock_ = -1;  ///< a descriptor of the folder
  bool is_resumed_ = false;
};

}  // namespace relief

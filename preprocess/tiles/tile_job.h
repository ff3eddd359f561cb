// The folder in which a conversion in tiles keeps what is done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "common/error.h"

namespace relief {

/// Where a conversion keeps what is done of some tiles.
class TileFolder {
 public:
  explicit TileFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path layout() const { return folder_ / "layout"; }
  [[nodiscard]] std::filesystem::path turns() const { return folder_ / "turns"; }
  [[nodiscard]] std::filesystem::path survey(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path rim(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path cosines(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part_report(std::size_t tile) const;

 protected:
  std::filesystem::path folder_;
};

/// A conversion's own folder, beside its output and on the same disk. It stays when the conversion
/// ends early, so that the same conversion can go on; nobody else works in it meanwhile.
class TileJob : public TileFolder {
 public:
  /// Opens the folder of the conversion to `output`, or makes it. `fingerprint` says what is
  /// converted and how: what another conversion left there is removed first. Fails with one
  /// sentence if a folder of that name is not a conversion's, another process works in it, or it
  /// can't be written to.
  static Result<TileJob> open(const std::filesystem::path& output, const std::string& fingerprint);

  /// Where the folder of the conversion to `output` is.
  [[nodiscard]] static std::filesystem::path folder_of(const std::filesystem::path& output);

  TileJob(TileJob&& other) noexcept;
  TileJob& operator=(TileJob&& other) noexcept;
  TileJob(const TileJob&) = delete;
  TileJob& operator=(const TileJob&) = delete;
  ~TileJob();

  /// Whether an earlier run has left something.
  [[nodiscard]] bool is_resumed() const { return is_resumed_; }

  /// The whole file, before it is moved to its place.
  [[nodiscard]] std::filesystem::path whole() const { return folder_ / "whole.relief"; }
  /// The folder within for the tiles of a coarser level, 1 or more.
  [[nodiscard]] TileFolder overview(unsigned level) const;

  /// Removes all but the fingerprint, to begin anew.
  Status clear() const;
  /// Removes the folder: all is done.
  void remove() const;

 private:
  TileJob(std::filesystem::path folder, int lock, bool is_resumed)
      : TileFolder(std::move(folder)), lock_(lock), is_resumed_(is_resumed) {}

  int lock_ = -1;  ///< a descriptor of the folder
  bool is_resumed_ = false;
};

}  // namespace relief

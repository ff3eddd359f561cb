// The folder in which a conversion in tiles keeps what is done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "common/error.h"

namespace relief {

/// A conversion's own folder, beside its output and on the same disk. It stays when the conversion
/// ends early, so that the same conversion can go on; nobody else works in it meanwhile.
class TileJob {
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

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Whether an earlier run has left something.
  [[nodiscard]] bool is_resumed() const { return is_resumed_; }

  [[nodiscard]] std::filesystem::path layout() const { return folder_ / "layout"; }
  [[nodiscard]] std::filesystem::path joined() const { return folder_ / "joined.relief"; }
  [[nodiscard]] std::filesystem::path turns() const { return folder_ / "turns"; }
  [[nodiscard]] std::filesystem::path survey(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path rim(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path cosines(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part(std::size_t tile) const;
  [[nodiscard]] std::filesystem::path part_report(std::size_t tile) const;

  /// Removes all but the fingerprint, to begin anew.
  Status clear() const;
  /// Removes the folder: all is done.
  void remove() const;

 private:
  TileJob(std::filesystem::path folder, int lock, bool is_resumed)
      : folder_(std::move(folder)), lock_(lock), is_resumed_(is_resumed) {}
  void remove_temporary() const;

  std::filesystem::path folder_;
  int lock_ = -1;  ///< a descriptor of the folder
  bool is_resumed_ = false;
};

}  // namespace relief

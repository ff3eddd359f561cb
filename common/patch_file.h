// The .relief patch file, version 1 (docs/patch-file.md). Reading trusts no byte of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"

namespace relief {

/// What the header and the index of a patch file say; known without reading any patch.
struct PatchFileInfo {
  std::uint32_t version = 0;
  std::string codec;
  std::uint64_t patches = 0;
  std::uint64_t samples = 0;
  double spacing = 0.0;  ///< as PatchModel::spacing, world units
  std::uint64_t file_bytes = 0;
  Bounds bounds;
  double bounding_radius = 0.0;
  std::vector<std::string> attributes;  ///< "normal", "colour"
};

/// Writes a model beside `path` and renames it there, so that `path` never holds half a file.
/// The same model gives the same bytes. Fails with one sentence (no such directory, disk full,
/// ...).
Status write_patch_file(const std::filesystem::path& path, const PatchModel& model);

/// An open patch file: header and index are in memory, patches are read on demand.
class PatchFile {
 public:
  /// Opens and checks header and index. One sentence if the file is missing, no patch file, of a
  /// newer version, truncated or inconsistent.
  static Result<PatchFile> open(const std::filesystem::path& path);

  PatchFile(PatchFile&&) noexcept;
  PatchFile& operator=(PatchFile&&) noexcept;
  ~PatchFile();

  [[nodiscard]] const PatchFileInfo& info() const;

  /// Reads, checks and decodes one patch; touches no other patch's bytes. Thread-safe.
  [[nodiscard]] Result<Patch> read_patch(std::uint64_t index) const;

  /// Reads all patches (in parallel).
  [[nodiscard]] Result<PatchModel> read_all(Progress& progress) const;

 private:
  struct State;
  explicit PatchFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace relief

// The .relief patch file (docs/patch-file.md). Reading trusts no byte of the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"

namespace relief {

class ZstdContexts;
struct TreeTile;

/// What the header and the index of a patch file say; known without reading any patch.
struct PatchFileInfo {
  std::uint32_t version = 0;
  std::string codec;  ///< of the heights: "predicted-zstd" (1) or "levels-rans" (2)
  std::uint64_t patches = 0;
  std::uint64_t samples = 0;
  double spacing = 0.0;  ///< as PatchModel::spacing, world units
  std::uint64_t file_bytes = 0;
  std::uint64_t height_bytes = 0;  ///< of all chunks of heights, masks among them
  std::uint64_t normal_bytes = 0;
  std::uint64_t colour_bytes = 0;
  unsigned levels = 1;  ///< that read_level gives of the largest patch without decoding finer ones
  Bounds bounds;
  double bounding_radius = 0.0;
  std::vector<std::string> attributes;  ///< "normal", "colour"
  bool is_closed = false;               ///< as PatchModel::is_closed
};

/// What the index says of one patch: enough to place it and to cull it before it is read. Terms and
/// frame as in Patch.
struct PatchSummary {
  glm::dvec3 origin{0.0};
  glm::dmat3 axes{1.0};
  double spacing = 1.0;
  double height_step = 1.0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t samples = 0;
  std::uint16_t min_height = 0;  ///< of the samples' height indices; 0 without samples
  std::uint16_t max_height = 0;
  glm::i16vec2 cone_axis{0};  ///< of the normals over samples, octahedral, in the patch frame
  float cone_cosine = -1.0F;  ///< of the cone's half angle; -1 if nothing is known

  [[nodiscard]] bool operator==(const PatchSummary&) const = default;
};

/// A box about all samples that the patch can have by its summary, world.
[[nodiscard]] Bounds box_of(const PatchSummary& patch);

/// How a file is coded: quick to write and read, or in about half the bytes.
enum class PatchCodec : std::uint8_t { Fast, Compact };

inline constexpr double kLeastNormalDegrees = 0.1;
inline constexpr double kMostNormalDegrees = 90.0;

struct PatchFileOptions {
  PatchCodec codec = PatchCodec::Fast;
  /// The largest error of normals of Compact, in degrees, from kLeastNormalDegrees, which Fast
  /// always keeps, to kMostNormalDegrees, which keeps none: all are those of the heights. Where
  /// these are near enough none is kept anyway.
  double normal_degrees = 0.5;
};

/// Writes a model beside `path` and renames it there, so that `path` never holds half a file.
/// The same model gives the same bytes. Compact rounds where patches stand, so that no sample moves
/// by more than 0.1 height steps. Fails with one sentence (no such directory, disk full, ...).
Status write_patch_file(const std::filesystem::path& path, const PatchModel& model,
                        const PatchFileOptions& options = {});

/// An open patch file: header and index are in memory, patches are read on demand. Of a file with
/// tiles it has the model's own patches, of all tiles, and no coarser ones.
class PatchFile {
 public:
  /// Opens and checks header and index. One sentence if the file is missing, no patch file, of a
  /// newer version, truncated or inconsistent.
  static Result<PatchFile> open(const std::filesystem::path& path);

  /// The same of one of a file's tiles alone: PatchTree::open_tile().
  static Result<PatchFile> open_tile(const std::filesystem::path& path, const TreeTile& tile);

  PatchFile(PatchFile&&) noexcept;
  PatchFile& operator=(PatchFile&&) noexcept;
  ~PatchFile();

  /// The file's name, as errors begin.
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const PatchFileInfo& info() const;

  /// One for each patch.
  [[nodiscard]] const std::vector<PatchSummary>& patches() const;

  /// Reads, checks and decodes one patch; touches no other patch's bytes. Thread-safe.
  [[nodiscard]] Result<Patch> read_patch(std::uint64_t index) const;
  /// The same, quicker for who reads many; `zstd` is one thread's.
  [[nodiscard]] Result<Patch> read_patch(std::uint64_t index, ZstdContexts& zstd) const;

  /// What decoded patches take, at least.
  [[nodiscard]] std::uint64_t decoded_bytes(std::span<const std::uint64_t> patches) const;

  /// As read_patch, but every 2^level-th node each way alone, with a spacing as much larger, and
  /// without maps. In files that are compact no finer level is decoded. Thread-safe.
  [[nodiscard]] Result<Patch> read_level(std::uint64_t index, unsigned level) const;

  /// Reads some patches (in parallel), in their order. The caller looks at fits_memory() first.
  [[nodiscard]] Result<std::vector<Patch>> read_patches(std::span<const std::uint64_t> patches,
                                                        Progress& progress) const;

  /// Reads all patches (in parallel). Refuses a model that does not fit into this machine's memory.
  [[nodiscard]] Result<PatchModel> read_all(Progress& progress) const;

 private:
  struct State;
  explicit PatchFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Refuses patches that would take more than this machine's memory, in a sentence that begins with
/// `name`.
Status fits_memory(const std::string& name, std::uint64_t decoded_bytes);

}  // namespace relief

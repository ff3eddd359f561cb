// Reads and writes .relief patch files (docs/patch-file.md). Files are not trusted: every byte is
// checked.
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

/// The header and index of a patch file, known without reading any patch.
struct PatchFileInfo {
  std::uint32_t version = 0;
  std::string codec;  ///< "fast" (version 1) or "compact" (version 2)
  std::uint64_t patches = 0;
  std::uint64_t samples = 0;
  double spacing = 0.0;  ///< as PatchModel::spacing, world units
  std::uint64_t file_bytes = 0;
  std::uint64_t height_bytes = 0;  ///< of all chunks of heights, with masks
  std::uint64_t normal_bytes = 0;
  std::uint64_t colour_bytes = 0;
  std::uint64_t scalar_bytes = 0;
  unsigned levels = 1;  ///< levels of the largest patch that read_level decodes without finer ones
  Bounds bounds;
  double bounding_radius = 0.0;
  std::vector<glm::dvec3> extremes;  ///< as PatchModel::extremes
  Stance stance;
  std::vector<std::string> attributes;  ///< "normal", "colour"
  std::vector<ScalarInfo> scalars;      ///< as PatchModel::scalars
  bool is_closed = false;               ///< as PatchModel::is_closed
  bool is_joined = false;               ///< patches meet at seams, or those of each tile do
  bool is_of_points = false;            ///< as PatchModel::is_of_points
};

/// The index entry of one patch: enough to transform and cull it before it is read. Terms and frame
/// as in Patch.
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

/// Returns a world box about all samples that a patch with this summary can have.
[[nodiscard]] Bounds box_of(const PatchSummary& patch);

/// Texels a cell of the maps of a patch; 1 of those that it has not.
struct MapScales {
  std::uint32_t normals = 1;
  std::uint32_t colours = 1;
  std::uint32_t scalars = 1;  ///< of the first
};

/// The maps of patches that are read. Heights always are.
struct PatchSections {
  bool normals = true;
  bool colours = true;
  bool scalars = true;

  bool operator==(const PatchSections&) const = default;
};

/// Bytes of the chunks that were read of a patch file.
struct SectionBytes {
  std::uint64_t heights = 0;
  std::uint64_t normals = 0;
  std::uint64_t colours = 0;
  std::uint64_t scalars = 0;

  SectionBytes& operator+=(const SectionBytes& more);
  bool operator==(const SectionBytes&) const = default;
};

/// Codecs: Fast is quick to write and read, Compact takes about half the bytes.
enum class PatchCodec : std::uint8_t { Fast, Compact };

inline constexpr double kMinNormalDegrees = 0.1;
inline constexpr double kMaxNormalDegrees = 90.0;

struct PatchFileOptions {
  PatchCodec codec = PatchCodec::Fast;
  /// Largest error of Compact's normals, in degrees: from kMinNormalDegrees, which Fast always
  /// keeps, to kMaxNormalDegrees, which stores no normals. Normals within this angle of those
  /// derived from the heights are not stored.
  double normal_degrees = 0.5;
};

/// Writes a model atomically: `path` never holds a partial file. Equal models give equal bytes.
/// Compact rounds the patches' origins, which moves no sample by more than 0.1 height steps. Fails
/// with one sentence (missing directory, disk full, ...).
Status write_patch_file(const std::filesystem::path& path, const PatchModel& model,
                        const PatchFileOptions& options = {});

/// An open patch file: header and index are in memory, patches are read on demand. For a file with
/// tiles it has the patches of all tiles of level 0, and no coarser ones.
class PatchFile {
 public:
  /// Opens a file and checks its header and index. Fails with one sentence if the file is missing,
  /// not a patch file, of a newer version, truncated or inconsistent.
  static Result<PatchFile> open(const std::filesystem::path& path);

  /// Opens one tile of a file; see PatchTree::open_tile().
  static Result<PatchFile> open_tile(const std::filesystem::path& path, const TreeTile& tile);

  PatchFile(PatchFile&&) noexcept;
  PatchFile& operator=(PatchFile&&) noexcept;
  ~PatchFile();

  /// The file's name, with which errors begin.
  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const PatchFileInfo& info() const;

  /// The index entries, one a patch.
  [[nodiscard]] const std::vector<PatchSummary>& patches() const;

  /// PatchModel::joined of these: one run, or one for each tile.
  [[nodiscard]] const std::vector<PatchRun>& joined() const;

  /// Reads, checks and decodes one patch; touches no other patch's bytes. Thread-safe.
  [[nodiscard]] Result<Patch> read_patch(std::uint64_t index) const;
  /// Reads one patch with the caller's decoder state, which is faster for many patches. `zstd`
  /// belongs to one thread. Maps that `sections` leaves out are empty, and their bytes not read.
  [[nodiscard]] Result<Patch> read_patch(std::uint64_t index, ZstdContexts& zstd,
                                         const PatchSections& sections = {}) const;

  /// Returns what the index says of a patch's maps, without reading them.
  [[nodiscard]] MapScales map_scales(std::uint64_t index) const;

  /// Returns the minimum memory that the decoded patches take, in bytes.
  [[nodiscard]] std::uint64_t decoded_bytes(std::span<const std::uint64_t> patches,
                                            const PatchSections& sections = {}) const;

  /// Returns the bytes of all chunks that have been read so far, as they are in the file; those of
  /// a chunk that was read twice count twice.
  [[nodiscard]] SectionBytes bytes_read() const;

  /// Reads every 2^level-th node of a patch in both directions, with a spacing 2^level times as
  /// large, and without maps. In compact files, finer levels are not decoded. Thread-safe.
  [[nodiscard]] Result<Patch> read_level(std::uint64_t index, unsigned level) const;

  /// Reads some patches in parallel and returns them in order. The caller checks fits_memory()
  /// first.
  [[nodiscard]] Result<std::vector<Patch>> read_patches(std::span<const std::uint64_t> patches,
                                                        Progress& progress,
                                                        const PatchSections& sections = {}) const;

  /// Reads all patches (in parallel). Refuses a model that does not fit into this machine's memory.
  [[nodiscard]] Result<PatchModel> read_all(Progress& progress,
                                            const PatchSections& sections = {}) const;

 private:
  struct State;
  explicit PatchFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Returns whether a path names a patch file: by its extension, and standard input ("-") by its
/// first bytes.
[[nodiscard]] bool names_patch_file(const std::filesystem::path& path);

/// Joining patches takes about this for each sample, if every one is at a border.
inline constexpr std::uint64_t kJoiningBytes = 256;

/// Fails if the patches would take more than this machine's memory. The error begins with `name`.
Status fits_memory(const std::string& name, std::uint64_t decoded_bytes);

}  // namespace relief

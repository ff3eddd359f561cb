// Reads a patch file patch by patch.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <utility>

#include "common/guard.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "common/io/standard_input.h"
#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/compact/level_grid.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fast/zstd_contexts.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/patch_tree_layout.h"

namespace relief {

namespace {

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr std::uint32_t kMaxMapTexels = 256;  // large maps are slow and find nothing more
#else
constexpr std::uint32_t kMaxMapTexels = kMaxPatchSide;
#endif

/// Returns whether a map with this many texels per cell is within the limits.
bool is_map_scale_valid(const PatchSummary& patch, std::uint32_t scale) {
  const std::uint64_t cells = std::max(patch.width, patch.height) - 1;
  return scale > 0 && scale * cells + 1 <= kMaxMapTexels;
}

/// Returns a patch as the index describes it, without heights and maps.
Patch empty_patch(const PatchSummary& summary) {
  Patch patch;
  patch.origin = summary.origin;
  patch.axes = summary.axes;
  patch.spacing = summary.spacing;
  patch.height_step = summary.height_step;
  patch.width = summary.width;
  patch.height = summary.height;
  return patch;
}

/// Keeps every 2^level-th node in both directions, of a patch without maps.
void keep_level(unsigned level, Patch& patch) {
  Patch coarse = patch;
  coarse.width = ((patch.width - 1) >> level) + 1;
  coarse.height = ((patch.height - 1) >> level) + 1;
  coarse.spacing = std::ldexp(patch.spacing, static_cast<int>(level));
  coarse.heights.clear();
  for (std::uint32_t j = 0; j < coarse.height; ++j) {
    for (std::uint32_t i = 0; i < coarse.width; ++i) {
      coarse.heights.push_back(patch.at(i << level, j << level));
    }
  }
  patch = std::move(coarse);
}

/// Viewers cull by the index's heights, so these must agree with the decoded ones. `all`: equal
/// them; otherwise (coarse levels) contain them.
Status check_height_range(const Patch& patch, const PatchSummary& summary, bool all) {
  std::int32_t lowest = kMaxHeightRange;
  std::int32_t highest = 0;
  for (const std::int32_t h : patch.heights) {
    if (h == kHole) continue;
    lowest = std::min(lowest, h);
    highest = std::max(highest, h);
  }
  if (summary.samples == 0) lowest = 0;
  const bool are_within = lowest >= summary.min_height && highest <= summary.max_height;
  const bool are_equal = lowest == summary.min_height && highest == summary.max_height;
  if (all ? !are_equal : !are_within) {
    return make_error("they are {} to {}, but the index states {} to {}", lowest, highest,
                      summary.min_height, summary.max_height);
  }
  return {};
}

/// Collects the information of header and index.
PatchFileInfo info_of(const FileHeader& header, const FileIndex& index) {
  PatchFileInfo info;
  info.version = header.version;
  const bool compact = header.version == kCompactVersion ||
                       std::any_of(index.chunks.begin(), index.chunks.end(),
                                   [](const auto& chunk) { return chunk.codec == kCodecCompact; });
  info.codec = compact ? "compact" : "fast";
  info.patches = header.patches;
  info.samples = header.samples;
  info.spacing = header.spacing;
  info.file_bytes = header.file_bytes;
  info.bounds = header.bounds;
  info.bounding_radius = header.bounding_radius;
  info.extremes = header.block.extremes;
  info.stance = header.block.stance;
  info.scalars = header.block.scalars;
  info.is_closed = header.is_closed;
  info.is_of_points = header.is_of_points;
  info.is_joined = header.is_joined;
  bool has_normals = false;
  bool has_colours = false;
  for (const ChunkRecord& chunk : index.chunks) {
    info.height_bytes += chunk.type == kHeightsChunk ? chunk.size : 0;
    info.normal_bytes += chunk.type == kNormalsChunk ? chunk.size : 0;
    info.colour_bytes += chunk.type == kColoursChunk ? chunk.size : 0;
    info.scalar_bytes += chunk.type == kScalarChunk ? chunk.size : 0;
    has_normals |= chunk.type == kNormalsChunk;
    has_colours |= chunk.type == kColoursChunk;
  }
  for (const PatchRecord& patch : index.patches) {
    if (!compact) break;
    const unsigned coarsest = coarsest_level(patch.summary.width, patch.summary.height);
    info.levels = std::max(info.levels, coarsest + 1);
  }
  if (has_normals) info.attributes.emplace_back("normal");
  if (has_colours) info.attributes.emplace_back("colour");
  return info;
}

/// `name` must outlive the call.
GuardedCall reading_index(const std::string& name) {
  return {.subject = name,
          .task = "read its index",
          .advice = "the file may be damaged: convert the scan again",
          .memory_advice = kMoreMemory};
}

}  // namespace

SectionBytes& SectionBytes::operator+=(const SectionBytes& more) {
  heights += more.heights;
  normals += more.normals;
  colours += more.colours;
  scalars += more.scalars;
  return *this;
}

struct PatchFile::State {
  std::string name;
  RandomAccessFile file;
  PatchFileInfo info;
  std::vector<PatchSummary> summaries;
  FileIndex index;
  std::vector<PatchRun> joined;
  /// By type, what patches have taken so far; counted by the threads that read them.
  mutable std::atomic<std::uint64_t> heights_read{0};
  mutable std::atomic<std::uint64_t> normals_read{0};
  mutable std::atomic<std::uint64_t> colours_read{0};
  mutable std::atomic<std::uint64_t> scalars_read{0};

  State(std::string file_name, RandomAccessFile opened, FileLayout layout)
      : name(std::move(file_name)),
        file(std::move(opened)),
        info(info_of(layout.header, layout.index)),
        index(std::move(layout.index)),
        joined(std::move(layout.joined)) {
    summaries.reserve(index.patches.size());
    for (const PatchRecord& patch : index.patches) summaries.push_back(patch.summary);
  }

  [[nodiscard]] const ChunkRecord* find_chunk(const PatchRecord& patch, ChunkType type) const {
    const auto first = index.chunks.begin() + patch.first_chunk;
    const auto found = std::find_if(first, first + patch.chunk_count,
                                    [type](const ChunkRecord& c) { return c.type == type; });
    return found == first + patch.chunk_count ? nullptr : &*found;
  }

  void count_bytes(const ChunkRecord& chunk) const {
    if (chunk.type == kHeightsChunk) heights_read += chunk.size;
    if (chunk.type == kNormalsChunk) normals_read += chunk.size;
    if (chunk.type == kColoursChunk) colours_read += chunk.size;
    if (chunk.type == kScalarChunk) scalars_read += chunk.size;
  }

  /// Reads one chunk and passes its bytes to `decode`, whose errors are clauses.
  template <class Decode>
  Status read_chunk(std::uint64_t patch, const char* what, const ChunkRecord& chunk,
                    const Decode& decode) const {
    if (chunk.codec != kCodecPredicted && chunk.codec != kCodecCompact) {
      return make_error(
          "{}: patch {}: its {} are in codec {}, which this program does not know; get a newer "
          "relief",
          name, patch, what, chunk.codec);
    }
    std::vector<std::byte> bytes(chunk.size);
    RELIEF_TRY(file.read_at(chunk.offset, bytes));
    count_bytes(chunk);
    if (!has_checksum(bytes, chunk.checksum)) {
      return make_error(
          "{}: patch {}: the checksum of its {} (byte {}) is wrong; the file is damaged", name,
          patch, what, chunk.offset);
    }
    if (Status decoded = decode(bytes); !decoded) {
      return make_error("{}: patch {}: its {} (byte {}) are wrong: {}; the file is damaged", name,
                        patch, what, chunk.offset, decoded.error().message);
    }
    return {};
  }

  /// Reads the maps of the table's scalars, if the patch has them.
  Status read_scalars(std::uint64_t number, Patch& patch, ZstdContexts& zstd) const {
    if (info.scalars.empty()) return {};
    const PatchRecord& record = index.patches[number];
    for (const ChunkRecord& chunk :
         std::span(index.chunks).subspan(record.first_chunk, record.chunk_count)) {
      if (chunk.type != kScalarChunk) continue;
      // A forged index may name one chunk many times.
      if (patch.scalars.size() == info.scalars.size()) {
        return make_error("{}: patch {}: has more scalars than the {} of the file; it is damaged",
                          name, number, info.scalars.size());
      }
      if (!is_map_scale_valid(record.summary, chunk.scale)) {
        return make_error("{}: patch {}: its scalars have {} texels a cell; the file is damaged",
                          name, number, chunk.scale);
      }
      RELIEF_TRY(read_chunk(number, "scalars", chunk, [&](const auto& bytes) -> Status {
        RELIEF_TRY_ASSIGN(auto map, chunk.codec == kCodecCompact
                                        ? decode_scalar_compact(bytes, chunk.scale, patch)
                                        : decode_scalar(bytes, chunk.scale, patch, zstd));
        patch.scalars.push_back(std::move(map));
        return {};
      }));
    }
    if (patch.scalars.empty() || patch.scalars.size() == info.scalars.size()) return {};
    return make_error("{}: patch {}: has {} scalars, but the file {}; the file is damaged", name,
                      number, patch.scalars.size(), info.scalars.size());
  }

  /// Reads a patch without its maps; for `level` 1 or more, every 2^level-th node in both
  /// directions.
  [[nodiscard]] Result<Patch> read_heights(std::uint64_t number, unsigned level,
                                           ZstdContexts& zstd) const {
    const PatchRecord& record = index.patches[number];
    Patch patch = empty_patch(record.summary);
    const ChunkRecord* heights = find_chunk(record, kHeightsChunk);
    if (heights == nullptr) {
      return make_error("{}: patch {} has no heights; the file is damaged", name, number);
    }
    const auto decode = [&](const std::vector<std::byte>& bytes) -> Status {
      const std::uint32_t samples = record.summary.samples;
      RELIEF_TRY(heights->codec == kCodecCompact
                     ? decode_heights_compact(bytes, samples, level, patch)
                     : decode_heights(bytes, samples, patch, zstd));
      if (heights->codec != kCodecCompact && level > 0) keep_level(level, patch);
      return check_height_range(patch, record.summary, level == 0);
    };
    RELIEF_TRY(read_chunk(number, "heights", *heights, decode));
    return patch;
  }
};

PatchFile::PatchFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
PatchFile::PatchFile(PatchFile&&) noexcept = default;
PatchFile& PatchFile::operator=(PatchFile&&) noexcept = default;
PatchFile::~PatchFile() = default;

Result<PatchFile> PatchFile::open(const std::filesystem::path& path) {
  RELIEF_TRY_ASSIGN(auto file, RandomAccessFile::open(path));
  const std::string name = path.string();
  return guarded(reading_index(name), [&]() -> Result<PatchFile> {
    RELIEF_TRY_ASSIGN(auto layout, read_own_layout(file, name));
    return PatchFile(std::make_unique<State>(name, std::move(file), std::move(layout)));
  });
}

Result<PatchFile> PatchFile::open_tile(const std::filesystem::path& path, const TreeTile& tile) {
  RELIEF_TRY_ASSIGN(auto file, RandomAccessFile::open(path));
  const std::string name = path.string();
  return guarded(reading_index(name), [&]() -> Result<PatchFile> {
    RELIEF_TRY_ASSIGN(auto layout, read_tile(file, tile, name));
    return PatchFile(std::make_unique<State>(name, std::move(file), std::move(layout)));
  });
}

const std::string& PatchFile::name() const {
  return state_->name;
}

const PatchFileInfo& PatchFile::info() const {
  return state_->info;
}

const std::vector<PatchSummary>& PatchFile::patches() const {
  return state_->summaries;
}

const std::vector<PatchRun>& PatchFile::joined() const {
  return state_->joined;
}

Result<Patch> PatchFile::read_patch(std::uint64_t index) const {
  ZstdContexts zstd;
  return read_patch(index, zstd);
}

Result<Patch> PatchFile::read_patch(std::uint64_t index, ZstdContexts& zstd,
                                    const PatchSections& sections) const try {
  const State& s = *state_;
  assert(index < s.index.patches.size() && "the caller checks info().patches");
  auto patch = s.read_heights(index, 0, zstd);
  if (!patch) return patch;
  const PatchRecord& record = s.index.patches[index];
  const auto read_map = [&](ChunkType type, const char* what, const auto& decode,
                            const auto& decode_compact) -> Status {
    const ChunkRecord* chunk = s.find_chunk(record, type);
    if (chunk == nullptr) return {};
    if (!is_map_scale_valid(record.summary, chunk->scale)) {
      return make_error("{}: patch {}: its {} have {} texels a cell; the file is damaged", s.name,
                        index, what, chunk->scale);
    }
    return s.read_chunk(index, what, *chunk, [&](const auto& bytes) {
      return chunk->codec == kCodecCompact ? decode_compact(bytes, chunk->scale, *patch)
                                           : decode(bytes, chunk->scale, *patch, zstd);
    });
  };
  if (sections.normals)
    RELIEF_TRY(read_map(kNormalsChunk, "normals", decode_normals, decode_normals_compact));
  if (sections.colours)
    RELIEF_TRY(read_map(kColoursChunk, "colours", decode_colours, decode_colours_compact));
  if (sections.scalars) RELIEF_TRY(s.read_scalars(index, *patch, zstd));
  return patch;
} catch (const std::bad_alloc&) {
  return make_error("{}: not enough memory to decode patch {}; {}", state_->name, index,
                    kMoreMemory);
}

Result<Patch> PatchFile::read_level(std::uint64_t index, unsigned level) const try {
  assert(index < state_->index.patches.size() && "the caller checks info().patches");
  ZstdContexts zstd;
  return state_->read_heights(index, level, zstd);
} catch (const std::bad_alloc&) {
  return make_error("{}: not enough memory to decode patch {}; {}", state_->name, index,
                    kMoreMemory);
}

SectionBytes PatchFile::bytes_read() const {
  return {state_->heights_read, state_->normals_read, state_->colours_read, state_->scalars_read};
}

MapScales PatchFile::map_scales(std::uint64_t index) const {
  assert(index < state_->index.patches.size() && "the caller checks info().patches");
  const PatchRecord& patch = state_->index.patches[index];
  const auto scale_of = [&](ChunkType type) -> std::uint32_t {
    const ChunkRecord* const chunk = state_->find_chunk(patch, type);
    // read_patch() refuses one that is not valid.
    return chunk != nullptr && is_map_scale_valid(patch.summary, chunk->scale) ? chunk->scale : 1U;
  };
  return {scale_of(kNormalsChunk), scale_of(kColoursChunk), scale_of(kScalarChunk)};
}

std::uint64_t PatchFile::decoded_bytes(std::span<const std::uint64_t> patches,
                                       const PatchSections& sections) const {
  const FileIndex& index = state_->index;
  std::uint64_t bytes = 0;
  for (const std::uint64_t number : patches) {
    const PatchRecord& patch = index.patches[number];
    const PatchSummary& summary = patch.summary;
    bytes += std::uint64_t{summary.width} * summary.height * sizeof(std::int32_t);
    for (std::uint32_t c = patch.first_chunk; c < patch.first_chunk + patch.chunk_count; ++c) {
      const ChunkRecord& chunk = index.chunks[c];
      if (!is_map_scale_valid(summary, chunk.scale)) continue;  // read_patch refuses it
      const auto texels = [&](std::uint64_t nodes) { return chunk.scale * (nodes - 1) + 1; };
      const std::uint64_t area = texels(summary.width) * texels(summary.height);
      if (chunk.type == kNormalsChunk && sections.normals) bytes += area * sizeof(glm::i16vec2);
      if (chunk.type == kColoursChunk && sections.colours) bytes += area * sizeof(glm::u8vec3);
      if (chunk.type == kScalarChunk && sections.scalars && !state_->info.scalars.empty())
        bytes += area * sizeof(std::uint16_t);
    }
  }
  return bytes;
}

bool names_patch_file(const std::filesystem::path& path) {
  if (lower_extension(path) == ".relief") return true;
  if (path != kStandardName) return false;
  const auto file = RandomAccessFile::open(path);
  std::array<std::byte, 8> first{};
  return file && file->size() >= first.size() && file->read_at(0, first) && has_magic(first);
}

}  // namespace relief

// Writes a patch file: encodes all patches in parallel, then lays them out in order.
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/guard.h"
#include "common/io/file.h"
#include "common/octahedral.h"
#include "common/patch_file/compact/compact_codec.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/patch_file/fault.h"
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_file_layout.h"
#include "common/patch_file/scalar_table.h"

namespace relief {
namespace {

struct EncodedChunk {
  ChunkType type{};
  std::uint16_t scale = 1;
  std::vector<std::byte> bytes;
};

struct EncodedPatch {
  PatchSummary summary;
  std::vector<EncodedChunk> chunks;
  std::string fault;  ///< why the patch cannot be written; a clause, empty if it can
};

template <class Texel>
std::string find_fault(const Patch& patch, const AttributeMap<Texel>& map, const char* what) {
  if (map.scale == 0 || map.scale > kMaxPatchSide ||
      map.width != std::uint64_t{map.scale} * (patch.width - 1) + 1 ||
      map.height != std::uint64_t{map.scale} * (patch.height - 1) + 1 ||
      map.texels.size() != std::size_t{map.width} * map.height) {
    return fmt::format(
        "its {} map of {}x{} texels does not fit its {}x{} nodes at {} texels a cell", what,
        map.width, map.height, patch.width, patch.height, map.scale);
  }
  if (map.width > kMaxPatchSide || map.height > kMaxPatchSide) {
    return fmt::format("its {} map of {}x{} texels is larger than {}x{}", what, map.width,
                       map.height, kMaxPatchSide, kMaxPatchSide);
  }
  return {};
}

/// Returns why the patch's file could not be read again, as a clause; empty if it can.
std::string find_fault(const Patch& patch, const PatchSummary& summary) {
  if (std::string fault = relief::find_fault(summary); !fault.empty()) return fault;
  if (patch.heights.size() != std::size_t{patch.width} * patch.height) {
    return fmt::format("it has {} heights for {}x{} nodes", patch.heights.size(), patch.width,
                       patch.height);
  }
  if (std::any_of(patch.heights.begin(), patch.heights.end(),
                  [](std::int32_t h) { return h != kHole && (h < 0 || h > kMaxHeightRange); })) {
    return fmt::format("a height is not within 0 to {}", kMaxHeightRange);
  }
  std::string fault;
  if (!patch.normals.empty()) fault = find_fault(patch, patch.normals, "normal");
  if (fault.empty() && !patch.colours.empty()) fault = find_fault(patch, patch.colours, "colour");
  for (const AttributeMap<std::uint16_t>& map : patch.scalars) {
    if (fault.empty()) fault = find_fault(patch, map, "scalar");
  }
  return fault;
}

/// Returns the normals as decoded from the file.
std::vector<glm::i16vec2> normals_as_read(const Patch& patch, const PatchFileOptions& options) {
  if (options.codec == PatchCodec::Compact) {
    return rounded_normals_compact(patch, normal_step(options.normal_degrees));
  }
  std::vector<glm::i16vec2> normals = patch.normals.texels;
  std::transform(normals.begin(), normals.end(), normals.begin(), rounded_normal);
  return normals;
}

/// Computes the cone about the mean normal that holds all kept normals.
void summarise_normals(const Patch& patch, const std::vector<glm::i16vec2>& normals,
                       PatchSummary& summary) {
  const std::vector<std::uint8_t> kept = kept_texels(patch, patch.normals.scale);
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] != 0) sum += unit_from_snorm16(normals[k]);
  }
  // Normals that cancel out have no cone.
  if (glm::length(sum) < 1e-3) return;
  summary.cone_axis = snorm16_from_unit(glm::normalize(sum));
  const glm::vec3 axis = unit_from_snorm16(summary.cone_axis);
  float cosine = 1.0F;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    cosine = std::min(cosine, glm::dot(axis, unit_from_snorm16(normals[k])));
  }
  // Slightly wider than measured, because of rounding in single precision.
  summary.cone_cosine = std::max(cosine - 1e-6F, -1.0F);
}

PatchSummary summarise(const Patch& patch) {
  PatchSummary summary;
  summary.origin = patch.origin;
  summary.axes = patch.axes;
  summary.spacing = patch.spacing;
  summary.height_step = patch.height_step;
  summary.width = patch.width;
  summary.height = patch.height;
  std::int32_t lowest = kMaxHeightRange;
  std::int32_t highest = 0;
  for (const std::int32_t h : patch.heights) {
    if (h == kHole) continue;
    ++summary.samples;
    lowest = std::min(lowest, h);
    highest = std::max(highest, h);
  }
  summary.min_height = static_cast<std::uint16_t>(summary.samples > 0 ? lowest : 0);
  summary.max_height = static_cast<std::uint16_t>(highest);
  return summary;
}

/// Encodes a patch without normals, for options that allow an error of a right angle.
EncodedPatch encode(const Patch& patch, const PatchFileOptions& options, ZstdContexts& zstd);
EncodedPatch encode_without_normals(const Patch& patch, PatchFileOptions options,
                                    ZstdContexts& zstd) {
  Patch plain = patch;
  take_normals_of_heights(plain);
  options.normal_degrees = kMinNormalDegrees;
  return encode(plain, options, zstd);
}

EncodedPatch encode(const Patch& patch, const PatchFileOptions& options, ZstdContexts& zstd) {
  const bool keeps_normals = options.normal_degrees < kMaxNormalDegrees;
  if (options.codec == PatchCodec::Compact && !keeps_normals && !patch.normals.empty()) {
    return encode_without_normals(patch, options, zstd);
  }
  EncodedPatch encoded;
  encoded.summary = summarise(patch);
  encoded.fault = find_fault(patch, encoded.summary);
  if (!encoded.fault.empty()) return encoded;
  const bool compact = options.codec == PatchCodec::Compact;
  encoded.chunks.push_back(
      {kHeightsChunk, 1, compact ? encode_heights_compact(patch) : encode_heights(patch, zstd)});
  if (!patch.normals.empty()) {
    summarise_normals(patch, normals_as_read(patch, options), encoded.summary);
    encoded.chunks.push_back(
        {kNormalsChunk, static_cast<std::uint16_t>(patch.normals.scale),
         compact ? encode_normals_compact(patch, normal_step(options.normal_degrees))
                 : encode_normals(patch, zstd)});
  }
  if (!patch.colours.empty()) {
    encoded.chunks.push_back(
        {kColoursChunk, static_cast<std::uint16_t>(patch.colours.scale),
         compact ? encode_colours_compact(patch) : encode_colours(patch, zstd)});
  }
  for (const AttributeMap<std::uint16_t>& map : patch.scalars) {
    encoded.chunks.push_back(
        {kScalarChunk, static_cast<std::uint16_t>(map.scale),
         compact ? encode_scalar_compact(patch, map) : encode_scalar(patch, map, zstd)});
  }
  return encoded;
}

/// Assigns each chunk its offset: patch after patch, without gaps, from `offset` on.
FileIndex lay_out(const std::vector<EncodedPatch>& patches, PatchCodec codec,
                  std::uint64_t offset) {
  FileIndex index;
  for (const EncodedPatch& patch : patches) {
    index.patches.push_back({patch.summary, static_cast<std::uint32_t>(index.chunks.size()),
                             static_cast<std::uint32_t>(patch.chunks.size())});
    for (const EncodedChunk& chunk : patch.chunks) {
      ChunkRecord record;
      record.type = chunk.type;
      record.codec = codec == PatchCodec::Compact ? kCodecCompact : kCodecPredicted;
      record.scale = chunk.scale;
      record.offset = offset;
      record.size = static_cast<std::uint32_t>(chunk.bytes.size());
      record.checksum = crc32(chunk.bytes);
      index.chunks.push_back(record);
      offset += chunk.bytes.size();
    }
  }
  return index;
}

/// Returns why the model's scalars cannot be written, as a clause; empty if they can.
std::string find_scalar_fault(const PatchModel& model) {
  for (const Patch& patch : model.patches) {
    if (!patch.scalars.empty() && patch.scalars.size() != model.scalars.size())
      return fmt::format("a patch has {} scalars, the model {}", patch.scalars.size(),
                         model.scalars.size());
  }
  return find_fault(std::span(model.scalars));
}

Status write_model(const std::filesystem::path& path, const PatchModel& model,
                   const PatchFileOptions& options) {
  if (const auto fault = find_fault(model.spacing, model.bounds, model.bounding_radius);
      !fault.empty()) {
    return make_error("{}: the model cannot be written: {}", path.string(), fault);
  }
  if (const std::string fault = find_scalar_fault(model); !fault.empty())
    return make_error("{}: the model cannot be written: {}", path.string(), fault);
  // Before encoding, so that a missing directory is reported at once.
  RELIEF_TRY_ASSIGN(auto file, AtomicFile::create(path));

  std::vector<EncodedPatch> encoded(model.patches.size());
  tbb::enumerable_thread_specific<ZstdContexts> zstd;
  tbb::parallel_for(std::size_t{0}, encoded.size(), [&](std::size_t i) {
    encoded[i] = encode(model.patches[i], options, zstd.local());
  });
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    if (!encoded[i].fault.empty()) {
      return make_error("{}: patch {} cannot be written: {}", path.string(), i, encoded[i].fault);
    }
  }

  const bool compact = options.codec == PatchCodec::Compact;
  const std::vector<std::byte> block =
      write_model_block({model.extremes, model.stance, model.scalars}, model.bounds);
  FileHeader header;
  header.block_bytes = static_cast<std::uint32_t>(block.size());
  const FileIndex layout = lay_out(encoded, options.codec, header.data_offset());
  header.version = compact ? kCompactVersion : kPlainVersion;
  header.spacing = model.spacing;
  header.bounds = model.bounds;
  header.bounding_radius = model.bounding_radius;
  header.is_closed = model.is_closed;
  header.is_joined = is_joined(model);
  header.is_borderless = header.is_joined && !model.is_closed && model.joined.front().is_closed;
  header.is_of_points = model.is_of_points;
  const std::vector<std::byte> index = write_index(layout, header);
  header.patches = static_cast<std::uint32_t>(layout.patches.size());
  header.chunks = static_cast<std::uint32_t>(layout.chunks.size());
  header.index_checksum = crc32(index);
  header.index_offset = header.data_offset();
  for (const ChunkRecord& chunk : layout.chunks) header.index_offset += chunk.size;
  header.file_bytes = header.index_offset + index.size();
  for (const EncodedPatch& patch : encoded) header.samples += patch.summary.samples;

  RELIEF_TRY(file.write(write_header(header)));
  RELIEF_TRY(file.write(block));
  for (const EncodedPatch& patch : encoded) {
    for (const EncodedChunk& chunk : patch.chunks) {
      RELIEF_TRY(file.write(chunk.bytes));
    }
  }
  RELIEF_TRY(file.write(index));
  return file.commit();
}

}  // namespace

Status write_patch_file(const std::filesystem::path& path, const PatchModel& model,
                        const PatchFileOptions& options) {
  const std::string name = path.string();
  return guarded({.subject = name,
                  .task = "write it",
                  .advice = kReportDefect,
                  .memory_advice = "free some memory, or convert with a larger --spacing"},
                 [&] { return write_model(path, model, options); });
}

}  // namespace relief

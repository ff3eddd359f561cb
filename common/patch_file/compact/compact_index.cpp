#include "common/patch_file/compact/compact_index.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/io/bytes.h"
#include "common/io/varint.h"
#include "common/octahedral.h"
#include "common/patch_file/compact/rotation_code.h"
#include "common/patch_file/fault.h"

namespace relief {
namespace {

/// The members that differ between patches of a model.
enum PatchFlag : std::uint8_t {
  OwnSpacing = 1,
  OwnHeightStep = 2,
  HasNormals = 4,
  HasColours = 8,
  HasScalars = 16,
  AllFlags = 31,
};

/// Positions up to this magnitude are distinct in double precision.
constexpr double kLargestPosition = 4503599627370496.0;  // 2^52

/// Cones are kept in bytes: an octahedral coordinate is 258 of 16 bits, a cosine 1 / 127.
constexpr std::int32_t kConeAxisStep = 258;
constexpr float kConeCosines = 127.0F;

glm::dvec3 steps_of(const glm::dvec3& position, const glm::dvec3& base, double step) {
  return glm::round((position - base) / step);
}

/// The height step that is stored once: the first patch's, because most models have only one.
double common_height_step(const FileIndex& index) {
  return index.patches.empty() ? 1.0 : index.patches.front().summary.height_step;
}

void append_chunk(const ChunkRecord& chunk, std::vector<std::byte>& out) {
  append_varint(out, chunk.size);
  if (chunk.size > 0) append_number(out, chunk.checksum);
}

/// Reads a chunk at `offset`. Returns false if the index ends within it or the chunk leaves the
/// file's data.
bool take_chunk(ByteReader& in, const FileHeader& header, ChunkRecord& chunk,
                std::uint64_t& offset) {
  std::uint64_t size = 0;
  if (!take_varint(in, size) || size > header.index_offset - offset || size > UINT32_MAX) {
    return false;
  }
  chunk.codec = kCodecCompact;
  chunk.offset = offset;
  chunk.size = static_cast<std::uint32_t>(size);
  offset += size;
  if (size == 0) return true;
  if (in.left() < sizeof(std::uint32_t)) return false;
  chunk.checksum = in.take<std::uint32_t>();
  return true;
}

/// The base of positions.
glm::dvec3 index_base(const Bounds& bounds) {
  return bounds.empty() ? glm::dvec3(0.0) : bounds.min;
}

/// The step of stored positions; 1 for a model without patches.
double instance_step(const std::vector<PatchRecord>& patches) {
  if (patches.empty()) return 1.0;
  double smallest = patches.front().summary.height_step;
  for (const PatchRecord& patch : patches) smallest = std::min(smallest, patch.summary.height_step);
  return std::exp2(std::floor(std::log2(smallest / 16.0)));
}

/// A patch's position, axes and normal cone as stored.
PatchSummary rounded_summary(const PatchSummary& patch, const glm::dvec3& base, double step) {
  PatchSummary rounded = patch;
  const glm::dvec3 positions = steps_of(patch.origin, base, step);
  // Beyond this distance, steps are not distinct and nothing is rounded.
  if (std::max({std::abs(positions.x), std::abs(positions.y), std::abs(positions.z)}) <
      kLargestPosition) {
    rounded.origin = base + positions * step;
  }
  rounded.axes = decode_rotation(encode_rotation(patch.axes));
  for (glm::length_t c = 0; c < 2; ++c) {
    const long steps = std::lround(static_cast<double>(patch.cone_axis[c]) / kConeAxisStep);
    rounded.cone_axis[c] = static_cast<std::int16_t>(steps * kConeAxisStep);
  }
  if (patch.cone_cosine <= -1.0F) return rounded;
  const float turned = std::acos(
      std::clamp(glm::dot(unit_from_snorm16(patch.cone_axis), unit_from_snorm16(rounded.cone_axis)),
                 -1.0F, 1.0F));
  const float angle =
      std::min(std::acos(std::clamp(patch.cone_cosine, -1.0F, 1.0F)) + turned, 3.2F);
  // A little wider for the rounding of single precision.
  const float cosine = angle < 3.14F ? std::cos(angle) - 1e-5F : -1.0F;
  rounded.cone_cosine = std::max(std::floor(cosine * kConeCosines) / kConeCosines, -1.0F);
  return rounded;
}

}  // namespace

std::vector<std::byte> write_compact_index(const FileIndex& index, const FileHeader& header) {
  const double step = instance_step(index.patches);
  const double height_step = common_height_step(index);
  const glm::dvec3 base = index_base(header.bounds);
  std::vector<std::byte> out;
  append_number(out, step);
  append_number(out, height_step);
  for (const PatchRecord& record : index.patches) {
    const PatchSummary patch = rounded_summary(record.summary, base, step);
    const std::span chunks(&index.chunks[record.first_chunk], record.chunk_count);
    const auto chunk_of = [&](ChunkType type) {
      const auto found = std::find_if(chunks.begin(), chunks.end(),
                                      [type](const ChunkRecord& c) { return c.type == type; });
      return found == chunks.end() ? nullptr : &*found;
    };
    const ChunkRecord* normals = chunk_of(kNormalsChunk);
    const ChunkRecord* colours = chunk_of(kColoursChunk);
    std::uint8_t flags = 0;
    if (patch.spacing != header.spacing) flags |= OwnSpacing;
    if (patch.height_step != height_step) flags |= OwnHeightStep;
    if (normals != nullptr) flags |= HasNormals;
    if (colours != nullptr) flags |= HasColours;
    const auto scalars =
        static_cast<std::uint64_t>(std::ranges::count(chunks, kScalarChunk, &ChunkRecord::type));
    if (scalars > 0) flags |= HasScalars;
    append_number(out, flags);
    if ((flags & OwnSpacing) != 0) append_number(out, patch.spacing);
    if ((flags & OwnHeightStep) != 0) append_number(out, patch.height_step);
    const glm::dvec3 steps = steps_of(patch.origin, base, step);
    for (glm::length_t c = 0; c < 3; ++c) append_signed(out, std::llround(steps[c]));
    for (const std::uint32_t word : encode_rotation(patch.axes)) append_number(out, word);
    append_varint(out, patch.width);
    append_varint(out, patch.height);
    append_varint(out, patch.samples);
    append_varint(out, patch.min_height);
    append_varint(out, patch.max_height - patch.min_height);
    append_number(out, static_cast<std::int8_t>(patch.cone_axis.x / kConeAxisStep));
    append_number(out, static_cast<std::int8_t>(patch.cone_axis.y / kConeAxisStep));
    append_number(out, static_cast<std::int8_t>(std::lround(patch.cone_cosine * kConeCosines)));
    append_chunk(*chunk_of(kHeightsChunk), out);
    for (const ChunkRecord* map : {normals, colours}) {
      if (map == nullptr) continue;
      append_varint(out, map->scale);
      append_chunk(*map, out);
    }
    if (scalars == 0) continue;
    append_varint(out, scalars);
    for (const ChunkRecord& chunk : chunks) {
      if (chunk.type != kScalarChunk) continue;
      append_varint(out, chunk.scale);
      append_chunk(chunk, out);
    }
  }
  return out;
}

Result<FileIndex> parse_compact_index(std::span<const std::byte> bytes, const FileHeader& header,
                                      const std::string& name) {
  ByteReader in(bytes);
  const auto damaged = [&](std::uint64_t patch, const char* what) {
    return make_error("{}: patch {} of the index is wrong: {}; the file is damaged", name, patch,
                      what);
  };
  if (in.left() < 2 * sizeof(double)) return damaged(0, "it is missing");
  const auto step = in.take<double>();
  const auto height_step = in.take<double>();
  if (!std::isfinite(step) || step <= 0.0)
    return damaged(0, "the step of positions is not above 0");
  const glm::dvec3 base = index_base(header.bounds);
  FileIndex index;
  index.patches.reserve(header.patches);
  std::uint64_t offset = header.data_offset();
  for (std::uint32_t p = 0; p < header.patches; ++p) {
    constexpr const char* kEnd = "the index ends within it";
    PatchRecord record;
    PatchSummary& patch = record.summary;
    if (in.left() < kMinCompactRecord) return damaged(p, kEnd);
    const auto flags = in.take<std::uint8_t>();
    if (flags > AllFlags) return damaged(p, "it has flags that this program does not know");
    patch.spacing = header.spacing;
    patch.height_step = height_step;
    for (const auto& [flag, value] :
         {std::pair{OwnSpacing, &patch.spacing}, std::pair{OwnHeightStep, &patch.height_step}}) {
      if ((flags & flag) == 0) continue;
      if (in.left() < sizeof(double)) return damaged(p, kEnd);
      *value = in.take<double>();
    }
    for (glm::length_t c = 0; c < 3; ++c) {
      std::int64_t steps = 0;
      if (!take_signed(in, steps)) return damaged(p, kEnd);
      patch.origin[c] = base[c] + static_cast<double>(steps) * step;
    }
    if (in.left() < sizeof(RotationCode)) return damaged(p, kEnd);
    RotationCode rotation{};
    for (std::uint32_t& word : rotation) word = in.take<std::uint32_t>();
    patch.axes = decode_rotation(rotation);
    std::array<std::uint64_t, 5> counts{};
    for (std::uint64_t& count : counts) {
      if (!take_varint(in, count)) return damaged(p, kEnd);
      if (count > UINT32_MAX) return damaged(p, "one of its counts is too large");
    }
    patch.width = static_cast<std::uint32_t>(counts[0]);
    patch.height = static_cast<std::uint32_t>(counts[1]);
    patch.samples = static_cast<std::uint32_t>(counts[2]);
    if (counts[3] + counts[4] > kMaxHeightRange) return damaged(p, "its heights are too far apart");
    patch.min_height = static_cast<std::uint16_t>(counts[3]);
    patch.max_height = static_cast<std::uint16_t>(counts[3] + counts[4]);
    if (in.left() < 3) return damaged(p, kEnd);
    patch.cone_axis.x = static_cast<std::int16_t>(in.take<std::int8_t>() * kConeAxisStep);
    patch.cone_axis.y = static_cast<std::int16_t>(in.take<std::int8_t>() * kConeAxisStep);
    patch.cone_cosine = std::max(static_cast<float>(in.take<std::int8_t>()) / kConeCosines, -1.0F);
    if (const std::string fault = find_fault(patch); !fault.empty()) {
      return damaged(p, fault.c_str());
    }

    record.first_chunk = static_cast<std::uint32_t>(index.chunks.size());
    std::vector<ChunkType> types{kHeightsChunk};
    if ((flags & HasNormals) != 0) types.push_back(kNormalsChunk);
    if ((flags & HasColours) != 0) types.push_back(kColoursChunk);
    bool has_count = (flags & HasScalars) == 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      ChunkRecord chunk;
      chunk.type = types[c];
      std::uint64_t scale = 1;
      if (c > 0 && (!take_varint(in, scale) || scale > UINT16_MAX)) {
        return damaged(p, "a map has no scale");
      }
      chunk.scale = static_cast<std::uint16_t>(scale);
      if (!take_chunk(in, header, chunk, offset)) {
        return damaged(p, "one of its chunks lies outside of the file's data");
      }
      index.chunks.push_back(chunk);
      ++record.chunk_count;
      if (has_count || c + 1 < types.size()) continue;
      std::uint64_t scalars = 0;
      if (!take_varint(in, scalars) || scalars > kMaxScalars)
        return damaged(p, "it has too many scalars");
      types.resize(types.size() + scalars, kScalarChunk);
      has_count = true;
    }
    index.patches.push_back(record);
  }
  if (in.left() > 0 || offset != header.index_offset) {
    return make_error("{}: the index does not end where it should; the file is damaged", name);
  }
  return index;
}

}  // namespace relief

#include "common/patch_file/patch_file_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/io/file.h"
#include "common/io/vector_bytes.h"
#include "common/patch_file/compact/compact_index.h"
#include "common/patch_file/fault.h"
#include "common/patch_file/plain_index.h"

namespace relief {
namespace {

// As in PNG: a byte above 127 and both line endings show a transfer that changed them.
constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'R', 'L', 'F', '\r', '\n', 0x1A, '\n'};

/// Returns whether the index may have that many bytes, on which later code relies.
bool index_fits(const FileHeader& header, std::uint64_t bytes) {
  if (header.version == kTreeVersion)
    return bytes == header.chunks * std::uint64_t{kTileRecordBytes};
  if (header.version == kCompactVersion) {
    return header.patches <= bytes / kMinCompactRecord &&
           header.chunks <= (3ULL + kMaxScalars) * header.patches;
  }
  return bytes == header.patches * std::uint64_t{kPatchRecordBytes} +
                      header.chunks * std::uint64_t{kChunkRecordBytes};
}

}  // namespace

Bounds box_of(const PatchSummary& patch) {
  Bounds box;
  for (const double i : {0.0, patch.width - 1.0}) {
    for (const double j : {0.0, patch.height - 1.0}) {
      for (const std::uint16_t h : {patch.min_height, patch.max_height}) {
        extend(box, patch.origin + patch.axes * glm::dvec3(i * patch.spacing, j * patch.spacing,
                                                           h * patch.height_step));
      }
    }
  }
  return box;
}

bool has_magic(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() &&
         std::equal(kMagic.begin(), kMagic.end(), bytes.begin(), [](std::uint8_t m, std::byte b) {
           return m == std::to_integer<std::uint8_t>(b);
         });
}

std::vector<std::byte> write_header(const FileHeader& header) {
  std::vector<std::byte> out;
  for (const std::uint8_t byte : kMagic) append_number(out, byte);
  append_number(out, header.version);
  append_number(out, static_cast<std::uint32_t>(kHeaderBytes));
  append_number(out, header.file_bytes);
  append_number(out, header.index_offset);
  append_number(out, header.patches);
  append_number(out, header.chunks);
  append_number(out, header.samples);
  append_number(out, header.spacing);
  append_vector(out, header.bounds.min);
  append_vector(out, header.bounds.max);
  append_number(out, header.bounding_radius);
  append_number(out, (header.is_closed ? kClosedFlag : std::uint64_t{0}) |
                         (header.is_joined ? kJoinedFlag : std::uint64_t{0}) |
                         (header.is_borderless ? kBorderlessFlag : std::uint64_t{0}) |
                         (header.is_of_points ? kPointsFlag : std::uint64_t{0}) |
                         (std::uint64_t{header.block_bytes} << kBlockSizeShift));
  append_number(out, header.index_checksum);
  append_number(out, crc32(out));
  assert(out.size() == kHeaderBytes && "the header has the size that the format defines");
  return out;
}

std::vector<std::byte> write_index(const FileIndex& index, const FileHeader& header) {
  if (header.version == kCompactVersion) return write_compact_index(index, header);
  return write_plain_index(index);
}

Result<FileHeader> parse_header(std::span<const std::byte> bytes, std::uint64_t file_bytes,
                                const std::string& name) {
  ByteReader in(bytes);
  for (const std::uint8_t expected : kMagic) {
    if (in.left() == 0 || in.take<std::uint8_t>() != expected) {
      return make_error("{}: is not a .relief patch file", name);
    }
  }
  if (in.left() < 4) return make_error("{}: the file is truncated within its header", name);
  const auto version = in.take<std::uint32_t>();
  if (version > kTreeVersion) {
    return make_error(
        "{}: patch file version {}; this program reads versions 1 to {}; get a newer relief", name,
        version, kTreeVersion);
  }
  if (bytes.size() < kHeaderBytes) {
    return make_error("{}: the file is truncated within its header", name);
  }
  ByteReader last(bytes.subspan(kHeaderBytes - 4));
  if (version == 0 || in.take<std::uint32_t>() != kHeaderBytes ||
      !has_checksum(bytes.first(kHeaderBytes - 4), last.take<std::uint32_t>())) {
    return make_error("{}: the header's checksum is wrong; the file is damaged", name);
  }

  FileHeader header;
  header.version = version;
  header.file_bytes = in.take<std::uint64_t>();
  header.index_offset = in.take<std::uint64_t>();
  header.patches = in.take<std::uint32_t>();
  header.chunks = in.take<std::uint32_t>();
  header.samples = in.take<std::uint64_t>();
  header.spacing = in.take<double>();
  header.bounds.min = take_vector(in);
  header.bounds.max = take_vector(in);
  header.bounding_radius = in.take<double>();
  const auto flags = in.take<std::uint64_t>();
  header.is_closed = (flags & kClosedFlag) != 0;
  header.is_joined = (flags & kJoinedFlag) != 0;
  header.is_borderless = (flags & kBorderlessFlag) != 0;
  header.is_of_points = (flags & kPointsFlag) != 0;
  header.block_bytes = static_cast<std::uint32_t>(flags >> kBlockSizeShift);
  header.index_checksum = in.take<std::uint32_t>();

  if (file_bytes != header.file_bytes) {
    return make_error("{}: the file has {} bytes, but its header states {}; it is {}", name,
                      file_bytes, header.file_bytes,
                      file_bytes < header.file_bytes ? "truncated" : "damaged");
  }
  if (header.block_bytes > kMaxModelBlock || header.index_offset < header.data_offset() ||
      header.index_offset > file_bytes || !index_fits(header, file_bytes - header.index_offset)) {
    return make_error(
        "{}: the index of {} patches and {} chunks does not fit at byte {}; the file "
        "is damaged",
        name, header.patches, header.chunks, header.index_offset);
  }
  if (const auto fault = find_fault(header.spacing, header.bounds, header.bounding_radius);
      !fault.empty()) {
    return make_error("{}: the model is wrong: {}; the file is damaged", name, fault);
  }
  return header;
}

Result<FileIndex> parse_index(std::span<const std::byte> bytes, const FileHeader& header,
                              const std::string& name) {
  if (!has_checksum(bytes, header.index_checksum)) {
    return make_error("{}: the index's checksum is wrong; the file is damaged", name);
  }
  auto index = header.version == kCompactVersion ? parse_compact_index(bytes, header, name)
                                                 : parse_plain_index(bytes, header, name);
  if (!index) return index;
  std::uint64_t samples = 0;
  for (const PatchRecord& patch : index->patches) samples += patch.summary.samples;
  if (samples != header.samples) {
    return make_error(
        "{}: the patches have {} samples, but the header states {}; the file is damaged", name,
        samples, header.samples);
  }
  return index;
}

Result<FileHeader> read_header(const RandomAccessFile& file, FileRange range,
                               const std::string& name) {
  if (range.bytes == 0) return make_error("{}: the file is empty", name);
  std::vector<std::byte> bytes(std::min<std::uint64_t>(range.bytes, kHeaderBytes));
  RELIEF_TRY(file.read_at(range.offset, bytes));
  RELIEF_TRY_ASSIGN(auto header, parse_header(bytes, range.bytes, name));
  std::vector<std::byte> block(header.block_bytes);
  RELIEF_TRY(file.read_at(range.offset + kHeaderBytes, block));
  RELIEF_TRY_ASSIGN(header.block, parse_model_block(block, header.bounds, name));
  return header;
}

Result<FileLayout> read_layout(const RandomAccessFile& file, FileRange range,
                               const std::string& name) {
  RELIEF_TRY_ASSIGN(const auto header, read_header(file, range, name));
  if (header.version == kTreeVersion)
    return make_error("{}: its tiles have tiles of their own; the file is damaged", name);
  std::vector<std::byte> bytes(header.file_bytes - header.index_offset);
  RELIEF_TRY(file.read_at(range.offset + header.index_offset, bytes));
  RELIEF_TRY_ASSIGN(auto index, parse_index(bytes, header, name));
  for (ChunkRecord& chunk : index.chunks) chunk.offset += range.offset;
  FileLayout layout{header, std::move(index), {}};
  if (header.is_joined && header.patches > 0)
    layout.joined = {{0, header.patches, header.is_closed || header.is_borderless}};
  return layout;
}

}  // namespace relief

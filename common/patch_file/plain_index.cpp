#include "common/patch_file/plain_index.h"

#include "common/io/vector_bytes.h"
#include "common/patch_file/fault.h"

namespace relief {
namespace {

void append_patch(std::vector<std::byte>& out, const PatchRecord& record) {
  const PatchSummary& patch = record.summary;
  append_vector(out, patch.origin);
  for (glm::length_t c = 0; c < 3; ++c) append_vector(out, patch.axes[c]);
  append_number(out, patch.spacing);
  append_number(out, patch.height_step);
  append_number(out, patch.width);
  append_number(out, patch.height);
  append_number(out, patch.samples);
  append_number(out, patch.min_height);
  append_number(out, patch.max_height);
  append_number(out, patch.cone_axis.x);
  append_number(out, patch.cone_axis.y);
  append_number(out, patch.cone_cosine);
  append_number(out, record.first_chunk);
  append_number(out, record.chunk_count);
}

PatchRecord take_patch(ByteReader& in) {
  PatchRecord record;
  PatchSummary& patch = record.summary;
  patch.origin = take_vector(in);
  for (glm::length_t c = 0; c < 3; ++c) patch.axes[c] = take_vector(in);
  patch.spacing = in.take<double>();
  patch.height_step = in.take<double>();
  patch.width = in.take<std::uint32_t>();
  patch.height = in.take<std::uint32_t>();
  patch.samples = in.take<std::uint32_t>();
  patch.min_height = in.take<std::uint16_t>();
  patch.max_height = in.take<std::uint16_t>();
  patch.cone_axis.x = in.take<std::int16_t>();
  patch.cone_axis.y = in.take<std::int16_t>();
  patch.cone_cosine = in.take<float>();
  record.first_chunk = in.take<std::uint32_t>();
  record.chunk_count = in.take<std::uint32_t>();
  return record;
}

void append_chunk(std::vector<std::byte>& out, const ChunkRecord& chunk) {
  for (const char letter : chunk.type) append_number(out, static_cast<std::uint8_t>(letter));
  append_number(out, chunk.codec);
  append_number(out, chunk.scale);
  append_number(out, chunk.offset);
  append_number(out, chunk.size);
  append_number(out, chunk.checksum);
}

ChunkRecord take_chunk(ByteReader& in) {
  ChunkRecord chunk;
  for (char& letter : chunk.type) letter = static_cast<char>(in.take<std::uint8_t>());
  chunk.codec = in.take<std::uint16_t>();
  chunk.scale = in.take<std::uint16_t>();
  chunk.offset = in.take<std::uint64_t>();
  chunk.size = in.take<std::uint32_t>();
  chunk.checksum = in.take<std::uint32_t>();
  return chunk;
}

}  // namespace

std::vector<std::byte> write_plain_index(const FileIndex& index) {
  std::vector<std::byte> out;
  out.reserve(index.patches.size() * kPatchRecordBytes + index.chunks.size() * kChunkRecordBytes);
  for (const PatchRecord& patch : index.patches) append_patch(out, patch);
  for (const ChunkRecord& chunk : index.chunks) append_chunk(out, chunk);
  return out;
}

Result<FileIndex> parse_plain_index(std::span<const std::byte> bytes, const FileHeader& header,
                                    const std::string& name) {
  ByteReader in(bytes);
  FileIndex index;
  index.patches.reserve(header.patches);
  index.chunks.reserve(header.chunks);
  for (std::uint32_t i = 0; i < header.patches; ++i) {
    const PatchRecord patch = take_patch(in);
    std::string fault = find_fault(patch.summary);
    if (fault.empty() && std::uint64_t{patch.first_chunk} + patch.chunk_count > header.chunks) {
      fault = "its chunks are not in the index";
    }
    if (!fault.empty()) {
      return make_error("{}: patch {} is wrong: {}; the file is damaged", name, i, fault);
    }
    index.patches.push_back(patch);
  }
  for (std::uint32_t i = 0; i < header.chunks; ++i) {
    const ChunkRecord chunk = take_chunk(in);
    if (chunk.offset < header.data_offset() || chunk.offset > header.index_offset ||
        chunk.size > header.index_offset - chunk.offset) {
      return make_error("{}: chunk {} lies outside of the file's data; the file is damaged", name,
                        i);
    }
    index.chunks.push_back(chunk);
  }
  return index;
}

}  // namespace relief

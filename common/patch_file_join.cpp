#include "common/patch_file_join.h"

#include <algorithm>
#include <utility>

#include "common/file.h"
#include "common/patch_file_layout.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Chunks are copied in pieces of this size.
constexpr std::uint64_t kPieceBytes = std::uint64_t{4} << 20U;

struct Part {
  RandomAccessFile file;
  FileLayout layout;
};

Result<Part> open_part(const fs::path& path) {
  auto file = RandomAccessFile::open(path);
  if (!file) return file.error();
  auto layout = read_layout(*file, path.string());
  if (!layout) return layout.error();
  return Part{std::move(*file), std::move(*layout)};
}

/// Adds a part's index, its chunks moved to where they will be in the joined file.
void append_index(const FileIndex& part, std::uint64_t moved_by, FileIndex& all) {
  const auto before = static_cast<std::uint32_t>(all.chunks.size());
  for (PatchRecord patch : part.patches) {
    patch.first_chunk += before;
    all.patches.push_back(patch);
  }
  for (ChunkRecord chunk : part.chunks) {
    chunk.offset += moved_by;
    all.chunks.push_back(chunk);
  }
}

Status copy_chunks(const RandomAccessFile& part, const FileHeader& header, AtomicFile& out) {
  std::vector<std::byte> piece;
  for (std::uint64_t at = kHeaderBytes; at < header.index_offset; at += piece.size()) {
    piece.resize(std::min(kPieceBytes, header.index_offset - at));
    if (Status read = part.read_at(at, piece); !read) return read;
    if (Status written = out.write(piece); !written) return written;
  }
  return {};
}

}  // namespace

Status join_patch_files(const fs::path& path, const std::vector<fs::path>& parts,
                        const JoinedModel& model) {
  FileHeader header;
  header.spacing = model.spacing;
  header.bounds = model.bounds;
  header.bounding_radius = model.bounding_radius;
  header.index_offset = kHeaderBytes;
  FileIndex index;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto part = open_part(parts[p]);
    if (!part) return part.error();
    if (p > 0 && part->layout.header.version != header.version) {
      return make_error("{}: is of version {}, other parts of version {}", parts[p].string(),
                        part->layout.header.version, header.version);
    }
    header.version = part->layout.header.version;
    header.samples += part->layout.header.samples;
    append_index(part->layout.index, header.index_offset - kHeaderBytes, index);
    header.index_offset += part->layout.header.index_offset - kHeaderBytes;
  }
  const std::vector<std::byte> index_bytes = write_index(index, header);
  header.patches = static_cast<std::uint32_t>(index.patches.size());
  header.chunks = static_cast<std::uint32_t>(index.chunks.size());
  header.index_checksum = crc32(index_bytes);
  header.file_bytes = header.index_offset + index_bytes.size();

  auto out = AtomicFile::create(path);
  if (!out) return out.error();
  if (Status written = out->write(write_header(header)); !written) return written;
  for (const fs::path& part_path : parts) {
    const auto part = open_part(part_path);
    if (!part) return part.error();
    if (Status copied = copy_chunks(part->file, part->layout.header, *out); !copied) return copied;
  }
  if (Status written = out->write(index_bytes); !written) return written;
  return out->commit();
}

}  // namespace relief

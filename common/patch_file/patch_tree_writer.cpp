// Writes tiles to one file: copied one after another, followed by their list.
#include <algorithm>

#include "common/io/file.h"
#include "common/patch_file/patch_tree.h"
#include "common/patch_file/patch_tree_layout.h"

namespace relief {
namespace {

/// Tiles are copied in pieces of this size.
constexpr std::uint64_t kPieceBytes = std::uint64_t{4} << 20U;

Result<FileLayout> layout_of(const TreePart& part) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(part.path));
  return read_layout(file, {0, file.size()}, part.path.string());
}

TreeTile tile_of(const TreePart& part, const FileLayout& layout) {
  TreeTile tile;
  tile.bytes = layout.header.file_bytes;
  tile.samples = layout.header.samples;
  tile.patches = layout.header.patches;
  tile.parent = part.parent;
  tile.level = part.level;
  tile.spacing = layout.header.spacing;
  tile.box = box_of(layout.index);
  return tile;
}

Status copy_tile(const TreePart& part, std::uint64_t bytes, AtomicFile& out) {
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(part.path));
  std::vector<std::byte> piece;
  for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
    piece.resize(std::min(kPieceBytes, bytes - at));
    RELIEF_TRY(file.read_at(at, piece));
    RELIEF_TRY(out.write(piece));
  }
  return {};
}

}  // namespace

Status write_patch_tree(const std::filesystem::path& path, const std::vector<TreePart>& parts,
                        const PatchModel& extent) {
  FileHeader header;
  header.version = kTreeVersion;
  header.spacing = extent.spacing;
  header.bounds = extent.bounds;
  header.bounding_radius = extent.bounding_radius;
  header.is_closed = extent.is_closed;
  const std::vector<std::byte> block =
      write_model_block({extent.extremes, extent.stance, extent.scalars}, extent.bounds);
  header.block_bytes = static_cast<std::uint32_t>(block.size());
  header.index_offset = header.data_offset();
  header.chunks = static_cast<std::uint32_t>(parts.size());
  std::vector<TreeTile> tiles;
  for (const TreePart& part : parts) {
    assert((part.parent == kNoTile || part.parent < tiles.size()) && "parents come first");
    RELIEF_TRY_ASSIGN(const auto layout, layout_of(part));
    const TreeTile tile = tile_of(part, layout);
    header.is_joined |= tile.level == 0 && !layout.joined.empty();
    header.index_offset += tile.bytes;
    header.patches += tile.level == 0 ? tile.patches : 0;
    header.samples += tile.level == 0 ? tile.samples : 0;
    tiles.push_back(tile);
  }
  const std::vector<std::byte> index = write_tree_index(tiles);
  header.index_checksum = crc32(index);
  header.file_bytes = header.index_offset + index.size();

  RELIEF_TRY_ASSIGN(auto out, AtomicFile::create(path));
  RELIEF_TRY(out.write(write_header(header)));
  RELIEF_TRY(out.write(block));
  for (std::size_t t = 0; t < parts.size(); ++t) {
    RELIEF_TRY(copy_tile(parts[t], tiles[t].bytes, out));
  }
  RELIEF_TRY(out.write(index));
  return out.commit();
}

}  // namespace relief

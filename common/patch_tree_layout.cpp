#include "common/patch_tree_layout.h"

#include <cmath>

#include "common/bytes.h"
#include "common/file.h"

namespace relief {
namespace {

void append_vector(std::vector<std::byte>& out, const glm::dvec3& v) {
  for (glm::length_t c = 0; c < 3; ++c) append_number(out, v[c]);
}

glm::dvec3 take_vector(ByteReader& in) {
  glm::dvec3 v;
  for (glm::length_t c = 0; c < 3; ++c) v[c] = in.take<double>();
  return v;
}

TreeTile take_tile(ByteReader& in) {
  TreeTile tile;
  tile.bytes = in.take<std::uint64_t>();
  tile.samples = in.take<std::uint64_t>();
  tile.patches = in.take<std::uint32_t>();
  tile.parent = in.take<std::uint32_t>();
  tile.level = in.take<std::uint32_t>();
  tile.spacing = in.take<double>();
  tile.box.min = take_vector(in);
  tile.box.max = take_vector(in);
  return tile;
}

/// What speaks against a tile after those before it, as a clause; empty if nothing does.
std::string find_fault(const TreeTile& tile, const std::vector<TreeTile>& before) {
  if (tile.level >= kMostTreeLevels) return fmt::format("its level is {}", tile.level);
  if (tile.parent != kNoTile) {
    if (tile.parent >= before.size()) return "its parent does not come before it";
    if (before[tile.parent].level != tile.level + 1) return "its parent is not of the level above";
  }
  return relief::find_fault(tile.spacing, tile.box, 0.0);
}

Status check_sums(const std::vector<TreeTile>& tiles, const FileHeader& header,
                  const std::string& name) {
  std::uint64_t bytes = kHeaderBytes;
  std::uint64_t patches = 0;
  std::uint64_t samples = 0;
  for (const TreeTile& tile : tiles) {
    bytes += tile.bytes;
    if (tile.level > 0) continue;
    patches += tile.patches;
    samples += tile.samples;
  }
  if (bytes == header.index_offset && patches == header.patches && samples == header.samples)
    return {};
  return make_error(
      "{}: its tiles end at byte {} and have {} patches with {} samples where the header says {}, "
      "{} and {}; the file is damaged",
      name, bytes, patches, samples, header.index_offset, header.patches, header.samples);
}

/// A file without tiles as the one that it is.
Result<TreeTile> whole_file(const RandomAccessFile& file, const std::string& name) {
  const auto layout = read_layout(file, {0, file.size()}, name);
  if (!layout) return layout.error();
  const FileHeader& header = layout->header;
  TreeTile tile;
  tile.bytes = header.file_bytes;
  tile.samples = header.samples;
  tile.patches = header.patches;
  tile.spacing = header.spacing;
  tile.box = box_of(layout->index);
  return tile;
}

}  // namespace

std::vector<std::byte> write_tree_index(std::span<const TreeTile> tiles) {
  std::vector<std::byte> out;
  for (const TreeTile& tile : tiles) {
    append_number(out, tile.bytes);
    append_number(out, tile.samples);
    append_number(out, tile.patches);
    append_number(out, tile.parent);
    append_number(out, tile.level);
    append_number(out, tile.spacing);
    append_vector(out, tile.box.min);
    append_vector(out, tile.box.max);
  }
  assert(out.size() == tiles.size() * kTileRecordBytes && "as large as the format says");
  return out;
}

Result<std::vector<TreeTile>> parse_tree_index(std::span<const std::byte> bytes,
                                               const FileHeader& header, const std::string& name) {
  if (!has_checksum(bytes, header.index_checksum))
    return make_error("{}: the index's checksum is wrong; the file is damaged", name);
  ByteReader in(bytes);
  std::vector<TreeTile> tiles;
  tiles.reserve(header.chunks);
  std::uint64_t offset = kHeaderBytes;
  for (std::uint32_t t = 0; t < header.chunks; ++t) {
    TreeTile tile = take_tile(in);
    tile.offset = offset;
    std::string fault = find_fault(tile, tiles);
    if (tile.bytes < kHeaderBytes || tile.bytes > header.index_offset - offset)
      fault = fmt::format("it has {} bytes", tile.bytes);
    if (!fault.empty())
      return make_error("{}: tile {} is wrong: {}; the file is damaged", name, t, fault);
    offset += tile.bytes;
    tiles.push_back(tile);
  }
  const Status checked = check_sums(tiles, header, name);
  return checked ? Result(std::move(tiles)) : checked.error();
}

Result<TreeLayout> read_tree_layout(const RandomAccessFile& file, const std::string& name) {
  const auto header = read_header(file, {0, file.size()}, name);
  if (!header) return header.error();
  if (header->version != kTreeVersion) {
    const auto tile = whole_file(file, name);
    if (!tile) return tile.error();
    return TreeLayout{*header, {*tile}};
  }
  std::vector<std::byte> bytes(header->file_bytes - header->index_offset);
  if (Status read = file.read_at(header->index_offset, bytes); !read) return read.error();
  auto tiles = parse_tree_index(bytes, *header, name);
  if (!tiles) return tiles.error();
  return TreeLayout{*header, std::move(*tiles)};
}

Bounds box_of(const FileIndex& index) {
  Bounds box;
  for (const PatchRecord& patch : index.patches) {
    if (patch.summary.samples == 0) continue;
    const Bounds one = box_of(patch.summary);
    extend(box, one.min);
    extend(box, one.max);
  }
  return box;
}

}  // namespace relief

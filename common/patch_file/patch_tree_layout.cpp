#include "common/patch_file/patch_tree_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <utility>

#include "common/io/file.h"
#include "common/io/vector_bytes.h"
#include "common/patch_file/fault.h"

namespace relief {
namespace {

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

/// Returns what is wrong with a tile, given those before it, as a clause; empty if nothing is.
std::string find_fault(const TreeTile& tile, const std::vector<TreeTile>& before) {
  if (tile.level >= kMaxTreeLevels) return fmt::format("its level is {}", tile.level);
  if (tile.parent != kNoTile) {
    if (tile.parent >= before.size()) return "its parent does not come before it";
    if (before[tile.parent].level != tile.level + 1) return "its parent is not of the level above";
  }
  return relief::find_fault(tile.spacing, tile.box, 0.0);
}

Status check_sums(const std::vector<TreeTile>& tiles, const FileHeader& header,
                  const std::string& name) {
  std::uint64_t bytes = header.data_offset();
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
      "{}: its tiles end at byte {} and have {} patches with {} samples, but the header states {}, "
      "{} and {}; the file is damaged",
      name, bytes, patches, samples, header.index_offset, header.patches, header.samples);
}

/// Returns a file without tiles as a single tile.
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

/// Adds a tile's patches to those of the tiles before.
void append_index(const FileIndex& from, FileIndex& to) {
  const auto before = static_cast<std::uint32_t>(to.chunks.size());
  for (PatchRecord patch : from.patches) {
    patch.first_chunk += before;
    to.patches.push_back(patch);
  }
  to.chunks.insert(to.chunks.end(), from.chunks.begin(), from.chunks.end());
}

/// Returns whether a box contains another one, up to the rounding of their sides.
bool holds(const Bounds& box, const Bounds& inner, double slack) {
  return inner.empty() ||
         (!box.empty() && glm::all(glm::lessThanEqual(box.min - slack, inner.min)) &&
          glm::all(glm::greaterThanEqual(box.max + slack, inner.max)));
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
  assert(out.size() == tiles.size() * kTileRecordBytes && "the size that the format defines");
  return out;
}

Result<std::vector<TreeTile>> parse_tree_index(std::span<const std::byte> bytes,
                                               const FileHeader& header, const std::string& name) {
  if (!has_checksum(bytes, header.index_checksum))
    return make_error("{}: the index's checksum is wrong; the file is damaged", name);
  ByteReader in(bytes);
  std::vector<TreeTile> tiles;
  tiles.reserve(header.chunks);
  std::uint64_t offset = header.data_offset();
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
    RELIEF_TRY_ASSIGN(const auto tile, whole_file(file, name));
    return TreeLayout{*header, {tile}};
  }
  std::vector<std::byte> bytes(header->file_bytes - header->index_offset);
  RELIEF_TRY(file.read_at(header->index_offset, bytes));
  RELIEF_TRY_ASSIGN(auto tiles, parse_tree_index(bytes, *header, name));
  return TreeLayout{*header, std::move(tiles)};
}

Result<FileLayout> read_tile(const RandomAccessFile& file, const TreeTile& tile,
                             const std::string& name) {
  auto layout = read_layout(file, {tile.offset, tile.bytes}, name);
  if (!layout) return layout;
  const FileHeader& header = layout->header;
  if (header.patches != tile.patches || header.samples != tile.samples ||
      header.spacing != tile.spacing || !holds(tile.box, box_of(layout->index), tile.spacing)) {
    return make_error("{}: the tile at byte {} differs from the list of tiles; the file is damaged",
                      name, tile.offset);
  }
  return layout;
}

Result<FileLayout> read_own_layout(const RandomAccessFile& file, const std::string& name) {
  auto header = read_header(file, {0, file.size()}, name);
  if (!header) return header.error();
  if (header->version != kTreeVersion) return read_layout(file, {0, file.size()}, name);
  RELIEF_TRY_ASSIGN(const auto tree, read_tree_layout(file, name));
  FileLayout whole{tree.header, {}, {}};
  for (const TreeTile& tile : tree.tiles) {
    if (tile.level > 0) continue;
    RELIEF_TRY_ASSIGN(auto layout, read_tile(file, tile, name));
    if (whole.index.chunks.size() + layout.index.chunks.size() > UINT32_MAX) {
      return make_error("{}: has more than {} chunks; its tiles can be read one by one", name,
                        UINT32_MAX);
    }
    const auto before = static_cast<std::uint32_t>(whole.index.patches.size());
    for (const PatchRun& run : layout.joined)
      whole.joined.push_back({before + run.first, run.count, run.is_closed});
    append_index(layout.index, whole.index);
  }
  return whole;
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

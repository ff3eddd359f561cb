#include "preprocess/tiles/tile_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "common/io/file.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// Size of all buffers together.
constexpr std::size_t kBufferBytes = std::size_t{32} << 20U;
/// Files are read in pieces of about this size.
constexpr std::size_t kReadBytes = std::size_t{1} << 20U;

fs::path own_path(const fs::path& folder, std::size_t tile) {
  return folder / fmt::format("own-{}", tile);
}

fs::path halo_path(const fs::path& folder, std::size_t tile) {
  return folder / fmt::format("halo-{}", tile);
}

/// A record: a point's position, normal, colour, scalars and home, if it has them.
std::size_t record_bytes(const ScanAttributes& attributes, bool is_halo) {
  return sizeof(glm::dvec3) + (attributes.normals ? sizeof(glm::vec3) : 0) +
         (attributes.colours ? sizeof(glm::u8vec3) : 0) +
         attributes.scalars.size() * sizeof(double) + (is_halo ? sizeof(Home) : 0);
}

template <class T>
void put(std::vector<std::byte>& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof(T));
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}

template <class T>
void take(const std::byte*& at, std::vector<T>& values) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  at += sizeof(T);
  values.push_back(value);
}

Status load_part(const fs::path& path, std::uint64_t count, const ScanAttributes& attributes,
                 bool is_halo, TilePoints& tile) {
  if (count == 0) return {};
  RELIEF_TRY_ASSIGN(const auto file, RandomAccessFile::open(path));
  const std::size_t stride = record_bytes(attributes, is_halo);
  std::vector<std::byte> piece(kReadBytes / stride * stride);
  for (std::uint64_t at = 0; at < count * stride; at += piece.size()) {
    const auto size = std::min<std::uint64_t>(piece.size(), count * stride - at);
    const std::span<std::byte> bytes = std::span(piece).first(size);
    RELIEF_TRY(file.read_at(at, bytes));
    for (const std::byte* record = bytes.data(); record != bytes.data() + size;) {
      take(record, tile.points.positions);
      if (attributes.normals) take(record, tile.points.normals);
      if (attributes.colours) take(record, tile.points.colours);
      for (PointScalar& scalar : tile.points.scalars) take(record, scalar.values);
      if (is_halo) take(record, tile.home);
    }
  }
  return {};
}

}  // namespace

std::map<std::uint32_t, std::vector<std::size_t>> halo_by_home(const TilePoints& tile) {
  std::map<std::uint32_t, std::vector<std::size_t>> by_home;
  for (std::size_t h = 0; h < tile.home.size(); ++h) by_home[tile.home[h].tile].push_back(h);
  return by_home;
}

TileWriter::TileWriter(fs::path folder, const TileLayout& layout, ScanAttributes attributes)
    : layout_(layout),
      attributes_(std::move(attributes)),
      buffer_bytes_(kBufferBytes / (2 * layout.tiles.size())),
      own_(layout.tiles.size()),
      halo_(layout.tiles.size()),
      counts_(layout.tiles.size()) {
  for (std::size_t tile = 0; tile < layout.tiles.size(); ++tile) {
    own_[tile].path = own_path(folder, tile);
    halo_[tile].path = halo_path(folder, tile);
  }
}

Status TileWriter::add(const Points& block) {
  assert((!attributes_.normals || block.normals.size() == block.size()) &&
         (!attributes_.colours || block.colours.size() == block.size()) &&
         std::ranges::equal(block.scalars, attributes_.scalars, {}, &PointScalar::name,
                            &ScalarInfo::name));
  std::vector<std::uint32_t> halos;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::uint32_t own = layout_.tile_of(block.positions[i]);
    const Home home{own, static_cast<std::uint32_t>(counts_[own].own++)};
    RELIEF_TRY(append(own_[own], block, i, nullptr));
    layout_.find_halos(block.positions[i], own, halos);
    for (const std::uint32_t tile : halos) {
      ++counts_[tile].halo;
      RELIEF_TRY(append(halo_[tile], block, i, &home));
    }
  }
  return {};
}

Status TileWriter::append(Part& part, const Points& block, std::size_t i, const Home* home) {
  put(part.buffer, block.positions[i]);
  if (attributes_.normals) put(part.buffer, block.normals[i]);
  if (attributes_.colours) put(part.buffer, block.colours[i]);
  for (const PointScalar& scalar : block.scalars) put(part.buffer, scalar.values[i]);
  if (home != nullptr) put(part.buffer, *home);
  return part.buffer.size() < buffer_bytes_ ? Status{} : flush(part);
}

Status TileWriter::flush(Part& part) {
  std::ofstream out(part.path, std::ios::binary | std::ios::app);
  out.write(reinterpret_cast<const char*>(part.buffer.data()),
            static_cast<std::streamsize>(part.buffer.size()));
  out.close();
  part.buffer.clear();
  if (!out) return make_error("{}: cannot be written; is the disk full?", part.path.string());
  return {};
}

Status TileWriter::finish() {
  for (std::vector<Part>* parts : {&own_, &halo_}) {
    for (Part& part : *parts) {
      if (part.buffer.empty()) continue;
      RELIEF_TRY(flush(part));
    }
  }
  return {};
}

Result<TilePoints> load_tile(const fs::path& folder, std::uint32_t tile, TileCount count,
                             const ScanAttributes& attributes) {
  TilePoints loaded;
  const std::uint64_t all = count.own + count.halo;
  loaded.own = count.own;
  loaded.points.positions.reserve(all);
  if (attributes.normals) loaded.points.normals.reserve(all);
  if (attributes.colours) loaded.points.colours.reserve(all);
  for (const ScalarInfo& scalar : attributes.scalars) {
    loaded.points.scalars.push_back({scalar.name, scalar.is_label, {}});
    loaded.points.scalars.back().values.reserve(all);
  }
  loaded.home.reserve(count.halo);
  RELIEF_TRY(load_part(own_path(folder, tile), count.own, attributes, false, loaded));
  RELIEF_TRY(load_part(halo_path(folder, tile), count.halo, attributes, true, loaded));
  return loaded;
}

void remove_tile(const fs::path& folder, std::uint32_t tile) {
  std::error_code ignored;
  fs::remove(own_path(folder, tile), ignored);
  fs::remove(halo_path(folder, tile), ignored);
}

}  // namespace relief

#include "renderer/store/pool/patch_pool.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "renderer/store/patch_attributes.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Rows and positions that a pool begins with.
constexpr std::uint32_t kFirstRows = 4096;
constexpr std::uint32_t kFirstPositions = 16384;
constexpr std::uint32_t kFirstVertices = 4096;

/// Wider patches than this are rare; programs are set up for it from the beginning.
constexpr std::uint32_t kUsualLayerSide = 1007;

/// A larger copy of a buffer of `before` elements, the rest of which is not set.
template <class T>
Buffer enlarged(const Gl& gl, const char* label, const Buffer* buffer, std::uint32_t before,
                std::uint32_t count) {
  Buffer larger(gl, label);
  gl.NamedBufferStorage(larger.id(), static_cast<GLsizeiptr>(count * sizeof(T)), nullptr,
                        GL_DYNAMIC_STORAGE_BIT);
  if (buffer != nullptr && before > 0)
    gl.CopyNamedBufferSubData(buffer->id(), larger.id(), 0, 0,
                              static_cast<GLsizeiptr>(before * sizeof(T)));
  return larger;
}

template <class T>
Table enlarged_table(const Gl& gl, const char* label, GLenum texel, const Buffer* buffer,
                     std::uint32_t before, std::uint32_t count) {
  Table table{enlarged<T>(gl, label, buffer, before, count),
              Texture(gl, label, GLenum{GL_TEXTURE_BUFFER})};
  gl.TextureBuffer(table.texture.id(), texel, table.buffer.id());
  return table;
}

template <class T>
void write(const Gl& gl, const Buffer& buffer, std::uint32_t first, const std::vector<T>& list) {
  if (list.empty()) return;
  gl.NamedBufferSubData(buffer.id(), static_cast<GLintptr>(first * sizeof(T)),
                        static_cast<GLsizeiptr>(list.size() * sizeof(T)), list.data());
}

/// Takes places, of more if there are too few; `grow` makes room for a number of them.
template <class Grow>
std::uint32_t take(Spans& spans, std::uint32_t count, const Grow& grow) {
  if (const auto first = spans.take(count)) return *first;
  grow(spans.size() + std::max(count, spans.size() / 2));
  return *spans.take(count);
}

/// The index of a free element of a list, or of a new one.
template <class T>
std::uint32_t put(std::vector<T>& list, std::vector<std::uint32_t>& free, T made) {
  if (free.empty()) {
    list.push_back(std::move(made));
    return static_cast<std::uint32_t>(list.size() - 1);
  }
  const std::uint32_t at = free.back();
  free.pop_back();
  list[at] = std::move(made);
  return at;
}

/// Frees what an element holds.
template <class T>
void drop(std::vector<T>& list, std::vector<std::uint32_t>& free, std::uint32_t at) {
  const T gone(std::move(list[at]));
  free.push_back(at);
}

glm::ivec4 shifted(const glm::ivec4& map, const AtlasSpot& spot) {
  return map + glm::ivec4(spot.x, spot.y, spot.layer, 0);
}

}  // namespace

PatchPool::PatchPool(const Gl& gl, const StoreNeeds& needs, const PooledModel& model)
    : gl_(gl),
      needs_(needs),
      model_(model),
      store_{.table =
                 enlarged_table<shared::PatchInfo>(gl, "patch table", GL_RGBA32I, nullptr, 0, 1)},
      heights_(gl, height_format(), sizeof(std::uint16_t), kBandWidth),
      normals_(gl, normal_format(), sizeof(glm::i16vec2), kBandWidth),
      colours_(gl, colour_format(model.nearest_colours), sizeof(glm::u8vec4), kBandWidth),
      masks_(gl, mask_format(), sizeof(std::uint8_t), kBandWidth),
      widest_(kUsualLayerSide) {
  reserve_rows(kFirstRows);
  // The first row is of no patch: parts that are free belong to it.
  static_cast<void>(rows_.take(1));
  store_.patches.front().side = kUsualLayerSide;
  if (!needs.cells) return;
  store_.cells.emplace(
      CellStore{{}, {}, enlarged<glm::uvec2>(gl, "part positions", nullptr, 0, 1)});
  reserve_positions(kFirstPositions);
}

void PatchPool::reserve_rows(std::uint32_t count) {
  store_.table = enlarged_table<shared::PatchInfo>(gl_, "patch table", GL_RGBA32I,
                                                   &store_.table.buffer, rows_.size(), count);
  if (needs_.bodies) {
    const glm::dvec3 box = model_.body.box.max - model_.body.box.min;
    const auto diameter = static_cast<float>(model_.body.where.scale * glm::length(box));
    const std::vector<float> all(count, diameter);
    store_.bodies = make_table(gl_, "bodies", GL_R32F, std::span<const float>(all));
  }
  if (needs_.splats || !needs_.cells) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    store_.indices = make_buffer(gl_, "patch indices", std::span<const std::uint32_t>(indices));
  }
  store_.patches.resize(count);
  rows_.grow(count);
  ++store_.buffers_version;
}

void PatchPool::reserve_positions(std::uint32_t count) {
  CellStore& cells = *store_.cells;
  cells.positions =
      enlarged<glm::uvec2>(gl_, "part positions", &cells.positions, positions_.size(), count);
  cells.parts.resize(count);
  positions_.grow(count);
  attach_positions_everywhere();
  ++store_.buffers_version;
}

void PatchPool::attach_positions_everywhere() {
  CellStore& cells = *store_.cells;
  for (const Resident& resident : residents_) {
    for (const std::uint32_t page : resident.cell_pages)
      attach_positions(gl_, cells.positions, cells.pages[page]);
  }
  if (!store_.seams) return;
  store_.seams->attributes = make_patch_attributes(gl_, "seams", cells.positions,
                                                   sizeof(glm::uvec2), store_.seams->corners);
}

Result<ChunkSlot> PatchPool::add(const PatchChunk& chunk) {
  Resident resident;
  if (const Status placed = place(chunk, resident); !placed) {
    release(resident);
    return placed.error();
  }
  note_kinds(chunk);
  resident.is_there = true;
  const auto free = std::find_if(residents_.begin(), residents_.end(),
                                 [](const Resident& r) { return !r.is_there; });
  const auto slot = static_cast<ChunkSlot>(free - residents_.begin());
  if (free == residents_.end())
    residents_.push_back(std::move(resident));
  else
    *free = std::move(resident);
  return slot;
}

bool PatchPool::has_room(const PatchChunk& chunk) const {
  const auto fits = [](const std::optional<MapBand>& band, const MapArrayPool& pool) {
    return !band || pool.has_room(*band);
  };
  return fits(chunk.maps.heights, heights_) && fits(chunk.maps.normals, normals_) &&
         fits(chunk.maps.colours, colours_) && fits(chunk.maps.masks, masks_);
}

Result<bool> PatchPool::reserve(const MapBytes& bytes) {
  const auto reserve = [](double wanted, MapArrayPool& pool, std::optional<Texture>& texture) {
    return pool.reserve(static_cast<std::uint64_t>(wanted), texture);
  };
  RELIEF_TRY_ASSIGN(bool grown, reserve(bytes.colours, colours_, store_.colours));
  if (grown) return false;
  RELIEF_TRY_ASSIGN(grown, reserve(bytes.normals, normals_, store_.normals));
  if (grown) return false;
  RELIEF_TRY_ASSIGN(grown, reserve(bytes.masks, masks_, store_.masks));
  if (grown) return false;
  RELIEF_TRY_ASSIGN(grown, reserve(bytes.heights, heights_, store_.heights));
  return !grown;
}

Status PatchPool::place(const PatchChunk& chunk, Resident& resident) {
  RELIEF_TRY(add_maps(chunk, resident));
  add_pages(chunk, resident);
  add_rows(chunk, resident);
  if (!chunk.lists.seams.empty()) add_seams(chunk, resident);
  return check_errors(gl_, "a part of the model");
}

Status PatchPool::add_maps(const PatchChunk& chunk, Resident& resident) {
  const auto add = [](const std::optional<MapBand>& band, MapArrayPool& pool,
                      std::optional<Texture>& texture, std::optional<PlacedBand>& kept) -> Status {
    if (!band) return {};
    RELIEF_TRY_ASSIGN(kept, pool.add(*band, texture));
    return {};
  };
  RELIEF_TRY(add(chunk.maps.heights, heights_, store_.heights, resident.heights));
  RELIEF_TRY(add(chunk.maps.normals, normals_, store_.normals, resident.normals));
  RELIEF_TRY(add(chunk.maps.colours, colours_, store_.colours, resident.colours));
  return add(chunk.maps.masks, masks_, store_.masks, resident.masks);
}

void PatchPool::add_pages(const PatchChunk& chunk, Resident& resident) {
  for (const CellPageData& page : chunk.cells) {
    resident.bytes += page.bytes();
    resident.cell_pages.push_back(put(store_.cells->pages, free_cell_pages_,
                                      upload_page(gl_, page, store_.cells->positions)));
  }
  for (const std::vector<SampleRecord>& page : chunk.records) {
    resident.bytes += page.size() * sizeof(SampleRecord);
    resident.record_pages.push_back(put(store_.pages, free_record_pages_, upload_page(gl_, page)));
  }
}

void PatchPool::add_rows(const PatchChunk& chunk, Resident& resident) {
  const CollectedModel& lists = chunk.lists;
  resident.rows = static_cast<std::uint32_t>(chunk.table.size());
  resident.first_row =
      take(rows_, resident.rows, [this](std::uint32_t count) { reserve_rows(count); });
  const std::uint32_t first = resident.first_row;
  std::vector<shared::PatchInfo> table = chunk.table;
  for (shared::PatchInfo& row : table) {
    if (resident.heights) row.heights = shifted(row.heights, resident.heights->spot);
    if (resident.normals) row.normals = shifted(row.normals, resident.normals->spot);
    if (resident.colours) row.colours = shifted(row.colours, resident.colours->spot);
    if (resident.masks) row.masks = shifted(row.masks, resident.masks->spot);
  }
  write(gl_, store_.table.buffer, first, table);
  for (std::uint32_t k = 0; k < resident.rows; ++k) {
    StoredPatch& patch = store_.patches[first + k] = lists.patches[k];
    if (!resident.record_pages.empty())
      patch.records.page = resident.record_pages[patch.records.page];
  }
  resident.levels = lists.levels;
  for (StoredLevels& levels : resident.levels) levels.first += first;
  if (!store_.cells) return;

  resident.parts = static_cast<std::uint32_t>(lists.parts.size());
  resident.positions = static_cast<std::uint32_t>(lists.positions.size());
  resident.first_position = take(positions_, resident.positions,
                                 [this](std::uint32_t count) { reserve_positions(count); });
  std::vector<glm::uvec2> positions = lists.positions;
  for (glm::uvec2& position : positions) position.x += first;
  write(gl_, store_.cells->positions, resident.first_position, positions);
  for (std::uint32_t k = 0; k < resident.parts; ++k) {
    StoredPart& part = store_.cells->parts[resident.first_position + k] = lists.parts[k];
    part.patch += first;
    part.buffers.page = resident.cell_pages[part.buffers.page];
  }
}

void PatchPool::add_seams(const PatchChunk& chunk, Resident& resident) {
  if (!store_.seams) {
    Buffer corners = enlarged<std::uint32_t>(gl_, "seam corners", nullptr, 0, 1);
    VertexArray attributes =
        make_patch_attributes(gl_, "seams", store_.cells->positions, sizeof(glm::uvec2), corners);
    store_.seams.emplace(SeamStore{
        {},
        enlarged_table<shared::SeamVertex>(gl_, "seam vertices", GL_RGBA32F, nullptr, 0, 1),
        std::move(corners),
        std::move(attributes)});
    ++store_.programs_version;
  }
  SeamStore& seams = *store_.seams;
  resident.vertices = static_cast<std::uint32_t>(chunk.seam_vertices.size());
  resident.first_vertex = take(vertices_, resident.vertices, [&](std::uint32_t count) {
    count = std::max(count, kFirstVertices);
    seams.vertices = enlarged_table<shared::SeamVertex>(
        gl_, "seam vertices", GL_RGBA32F, &seams.vertices.buffer, vertices_.size(), count);
    vertices_.grow(count);
  });
  write(gl_, seams.vertices.buffer, resident.first_vertex, chunk.seam_vertices);
  resident.corners = static_cast<std::uint32_t>(chunk.seam_corners.size());
  resident.first_corner = take(corners_, resident.corners, [&](std::uint32_t count) {
    count = std::max(count, kFirstVertices);
    seams.corners =
        enlarged<std::uint32_t>(gl_, "seam corners", &seams.corners, corners_.size(), count);
    corners_.grow(count);
    seams.attributes = make_patch_attributes(gl_, "seams", store_.cells->positions,
                                             sizeof(glm::uvec2), seams.corners);
  });
  std::vector<std::uint32_t> corners = chunk.seam_corners;
  for (std::uint32_t& corner : corners) corner += resident.first_vertex;
  write(gl_, seams.corners, resident.first_corner, corners);
  resident.seams = chunk.lists.seams;
  for (StoredSeam& seam : resident.seams) {
    seam.patch += resident.first_row;
    seam.number += resident.first_position;
    for (SeamBlock& block : seam.blocks) block.first += resident.first_corner;
  }
}

void PatchPool::note_kinds(const PatchChunk& chunk) {
  bool changes = false;
  const std::vector<StoredPart>& parts = chunk.lists.parts;
  const auto note = [&](bool& known, auto PartBuffers::*count) {
    if (known || std::none_of(parts.begin(), parts.end(),
                              [count](const StoredPart& part) { return part.buffers.*count > 0; }))
      return;
    known = true;
    changes = true;
  };
  note(has_strips_, &PartBuffers::strip);
  note(has_runs_, &PartBuffers::runs);
  for (const StoredPatch& patch : chunk.lists.patches) {
    if (patch.side <= widest_) continue;
    widest_ = patch.side;
    changes = true;
  }
  if (changes) ++store_.programs_version;
}

void PatchPool::remove(ChunkSlot slot) {
  release(residents_[slot]);
  residents_[slot] = {};
}

void PatchPool::release(Resident& resident) {
  const auto remove = [](const std::optional<PlacedBand>& band, MapArrayPool& pool) {
    if (band) pool.remove(*band);
  };
  remove(resident.heights, heights_);
  remove(resident.normals, normals_);
  remove(resident.colours, colours_);
  remove(resident.masks, masks_);
  for (const std::uint32_t page : resident.cell_pages)
    drop(store_.cells->pages, free_cell_pages_, page);
  for (const std::uint32_t page : resident.record_pages)
    drop(store_.pages, free_record_pages_, page);
  for (std::uint32_t k = 0; k < resident.rows; ++k) store_.patches[resident.first_row + k] = {};
  rows_.give(resident.first_row, resident.rows);
  for (std::uint32_t k = 0; k < resident.parts; ++k)
    store_.cells->parts[resident.first_position + k] = {};
  positions_.give(resident.first_position, resident.positions);
  vertices_.give(resident.first_vertex, resident.vertices);
  corners_.give(resident.first_corner, resident.corners);
}

void PatchPool::show(std::span<const ShownChunk> chunks) {
  store_.instances.clear();
  store_.levels.clear();
  if (store_.seams) store_.seams->seams.clear();
  for (const ShownChunk& shown : chunks) {
    const Resident& resident = residents_[shown.slot];
    const auto number = static_cast<std::uint32_t>(store_.instances.size());
    StoredInstance instance;
    instance.first = static_cast<std::uint32_t>(store_.levels.size());
    // Patches that meet others are not left out: their neighbours' seams would end in nothing.
    const bool is_whole = shown.hidden.empty() || !resident.seams.empty();
    for (std::size_t k = 0; k < resident.levels.size(); ++k) {
      if (is_whole || !shown.hidden[k]) store_.levels.push_back(resident.levels[k]);
    }
    instance.count = static_cast<std::uint32_t>(store_.levels.size()) - instance.first;
    if (!resident.seams.empty()) {
      std::vector<StoredSeam>& seams = store_.seams->seams;
      instance.seams = {static_cast<std::uint32_t>(seams.size()),
                        static_cast<std::uint32_t>(resident.seams.size())};
      seams.insert(seams.end(), resident.seams.begin(), resident.seams.end());
    }
    if (model_.is_closed) instance.body = model_.body;
    for (std::uint32_t k = 0; k < resident.rows; ++k)
      store_.patches[resident.first_row + k].instance = number;
    store_.instances.push_back(std::move(instance));
  }
}

std::uint64_t PatchPool::bytes() const {
  std::uint64_t sum = heights_.bytes() + normals_.bytes() + colours_.bytes() + masks_.bytes() +
                      rows_.size() * (sizeof(shared::PatchInfo) + sizeof(shared::PatchView)) +
                      positions_.size() * sizeof(glm::uvec2) +
                      vertices_.size() * sizeof(shared::SeamVertex) +
                      corners_.size() * sizeof(std::uint32_t);
  for (const Resident& resident : residents_) sum += resident.bytes;
  return sum;
}

}  // namespace relief

// A model on the GPU whose patches come and go.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/pool/map_array_pool.h"
#include "renderer/store/pool/patch_chunk.h"
#include "renderer/store/pool/spans.h"

namespace relief {

/// What is known of the whole model before its first patch.
struct PooledModel {
  Body body;                     ///< about all of it, world frame
  bool is_closed = false;        ///< as PatchModel::is_closed
  bool nearest_colours = false;  ///< as upload_colours() has it
};

/// A chunk that is in a pool.
using ChunkSlot = std::uint32_t;

/// A chunk to be drawn.
struct ShownChunk {
  ChunkSlot slot = 0;
  /// By patch: whether it is left out. Empty: all are drawn, as are those that meet others.
  std::vector<bool> hidden = {};
};

/// Keeps chunks of patches on the GPU as one PatchStore, which engines draw like any other. Adding
/// a chunk copies its bytes; what is there stays where it is, but for buffers that are full, which
/// are replaced by larger copies on the GPU.
class PatchPool {
 public:
  /// `needs`: of all chunks. `gl` must outlive it.
  PatchPool(const Gl& gl, const StoreNeeds& needs, const PooledModel& model);

  /// Uploads a chunk that was prepared with the pool's needs. It is not drawn before show() says
  /// so. Fails if OpenGL has no memory for it; then it is not there.
  Result<ChunkSlot> add(const PatchChunk& chunk);

  /// Whether add() would copy the chunk's maps only, and not those of all others into larger
  /// textures; true also if that can't be helped.
  [[nodiscard]] bool has_room(const PatchChunk& chunk) const;

  /// Makes room for maps of so many bytes in all. At most one texture is made in a call, which
  /// takes a while where OpenGL runs on the CPU: 0.56 ms a megabyte. Returns whether there is room
  /// now.
  Result<bool> reserve(const MapBytes& bytes);

  /// Drops a chunk. show() has to be called before anything is drawn again.
  void remove(ChunkSlot slot);

  /// Draws these chunks from now on, and no others.
  void show(std::span<const ShownChunk> chunks);

  [[nodiscard]] const PatchStore& store() const { return store_; }

  /// Where all of the model stands.
  [[nodiscard]] const Body& body() const { return model_.body; }

  /// What all buffers and textures take, used or not.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  /// A chunk and where its parts are.
  struct Resident {
    bool is_there = false;
    std::uint64_t bytes = 0;  ///< of what is its own: cells, records
    std::uint32_t first_row = 0;
    std::uint32_t rows = 0;
    std::uint32_t first_position = 0;
    std::uint32_t parts = 0;
    std::uint32_t positions = 0;
    std::uint32_t first_vertex = 0;
    std::uint32_t vertices = 0;
    std::uint32_t first_corner = 0;
    std::uint32_t corners = 0;
    std::vector<std::uint32_t> cell_pages;
    std::vector<std::uint32_t> record_pages;
    std::vector<StoredLevels> levels;
    std::vector<StoredSeam> seams;
    std::optional<PlacedBand> heights;
    std::optional<PlacedBand> normals;
    std::optional<PlacedBand> colours;
    std::optional<PlacedBand> masks;
  };

  Status place(const PatchChunk& chunk, Resident& resident);
  Status add_maps(const PatchChunk& chunk, Resident& resident);
  void add_pages(const PatchChunk& chunk, Resident& resident);
  void add_rows(const PatchChunk& chunk, Resident& resident);
  void add_seams(const PatchChunk& chunk, Resident& resident);
  void note_kinds(const PatchChunk& chunk);
  void release(Resident& resident);
  void reserve_rows(std::uint32_t count);
  void reserve_positions(std::uint32_t count);
  void attach_positions_everywhere();

  const Gl& gl_;
  StoreNeeds needs_;
  PooledModel model_;
  PatchStore store_;
  std::vector<Resident> residents_;
  Spans rows_;
  Spans positions_;
  Spans vertices_;
  Spans corners_;
  std::vector<std::uint32_t> free_cell_pages_;
  std::vector<std::uint32_t> free_record_pages_;
  MapArrayPool heights_;
  MapArrayPool normals_;
  MapArrayPool colours_;
  MapArrayPool masks_;
  std::uint32_t widest_ = 0;
  bool has_strips_ = false;
  bool has_runs_ = false;
};

}  // namespace relief

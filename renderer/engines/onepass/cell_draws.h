// A frame's cells as OpenGL draws them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/engines/onepass/programs.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/cell_store.h"
#include "renderer/store/patch_store.h"
#include "renderer/store/seam_store.h"
#include "renderer/view/sided_list.h"

namespace relief::onepass {

/// What multi-draws-indirect read: one, or on the CPU as many as its memory asks for.
struct Commands {
  struct Slice {
    GLsizei first = 0;
    GLsizei count = 0;
    std::uint64_t triangles = 0;  ///< at most
  };
  Buffer buffer;
  std::vector<Slice> slices;
};

/// Slices of as many commands as reach `most` triangles, the last of fewer.
template <class Command>
[[nodiscard]] std::vector<Commands::Slice> slices_of(const std::vector<Command>& commands,
                                                     std::uint64_t most) {
  std::vector<Commands::Slice> slices;
  for (std::size_t c = 0; c < commands.size(); ++c) {
    if (slices.empty() || slices.back().triangles >= most)
      slices.push_back({static_cast<GLsizei>(c)});
    ++slices.back().count;
    slices.back().triangles += std::uint64_t{commands[c].count} * commands[c].instances;
  }
  return slices;
}

/// The parts that a frame draws, page by page; good for any number of passes over them.
struct CellDraws {
  struct Page {
    const CellPage* page = nullptr;
    bool front_alone = false;  ///< without what faces away
    std::optional<Commands> strips;
    std::optional<Commands> runs;
    std::optional<Commands> edges;
    std::optional<Commands> borders;
    std::optional<Commands> rims;
  };
  std::vector<Page> pages;
  const SeamStore* seams = nullptr;
  std::optional<Commands> seams_both;   ///< of patches that are drawn with both sides
  std::optional<Commands> seams_front;  ///< of those without what faces away
};

/// Which sides of a surface are drawn: both, or that alone which its normals point away from.
enum class SeenFrom : std::uint8_t { Anywhere, Behind };

/// Adds the seams of patches in a view (indices into `SeamStore::seams`). The store must outlive
/// the draws.
void add_seams(const Gl& gl, const PatchStore& store, const View& view, const SidedList& seams,
               SeenFrom seen, CellDraws& draws);

/// Draws these parts, in this order. The store must outlive the draws.
[[nodiscard]] CellDraws make_cell_draws(const Gl& gl, const CellStore& store,
                                        const SidedList& parts);

/// Runs the programs over them: cells, then what reaches beyond patches, which is mostly hidden by
/// then, then border cells and splats. The model must be bound (BoundModel).
void draw_cells(const Gl& gl, const Programs& programs, const CellDraws& draws,
                SeenFrom seen = SeenFrom::Anywhere);

}  // namespace relief::onepass

// Which patches a frame draws, in which order.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/patch_store.h"
#include "renderer/view.h"

namespace relief::onepass {

/// As glMultiDrawArraysIndirect reads it.
struct ArraysCommand {
  GLuint count = 0;
  GLuint instances = 1;
  GLuint first = 0;
  GLuint base_instance = 0;  ///< the patch, or with cells its part
};

/// As glMultiDrawElementsIndirect reads it.
struct ElementsCommand {
  GLuint count = 0;
  GLuint instances = 1;
  GLuint first_index = 0;
  GLint base_vertex = 0;
  GLuint base_instance = 0;  ///< as above
};

/// Quads per indirect command: as many as 16-bit vertex numbers reach.
inline constexpr std::uint32_t kQuadsPerCommand = 65536 / 4;

/// Appends commands that draw `quads` quads from the record `first` on.
void add_quads(std::uint32_t first, std::uint32_t quads, std::uint32_t instance,
               std::vector<ElementsCommand>& commands);

/// The patches in view, nearest first.
[[nodiscard]] std::vector<std::uint32_t> find_visible(const PatchStore& store, const View& view);

/// Of those, the ones with a point nearer to the eye's plane than `depth` (world units).
[[nodiscard]] std::vector<std::uint32_t> find_near(const PatchStore& store, const View& view,
                                                   const std::vector<std::uint32_t>& visible,
                                                   double depth);

/// Commands that draw one page's share of `patches`, a point per sample.
[[nodiscard]] std::vector<ArraysCommand> point_commands(const PatchStore& store,
                                                        const std::vector<std::uint32_t>& patches,
                                                        std::uint32_t page);

/// The same with a quad per sample, at most kQuadsPerCommand each.
[[nodiscard]] std::vector<ElementsCommand> quad_commands(const PatchStore& store,
                                                         const std::vector<std::uint32_t>& patches,
                                                         std::uint32_t page);

}  // namespace relief::onepass

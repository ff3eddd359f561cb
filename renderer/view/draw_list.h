// Which patches a frame draws, in which order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "renderer/gl/functions.h"
#include "renderer/store/patch_store.h"
#include "renderer/view/view.h"

namespace relief {

/// Sorts indices of things (with a sphere: `centre`, `radius`, world frame): those whose spheres
/// begin nearest to the eye first.
template <class Thing>
[[nodiscard]] std::vector<std::uint32_t> nearest_first(const std::vector<Thing>& things,
                                                       const View& view,
                                                       std::vector<std::uint32_t> visible) {
  std::vector<double> distance(things.size());
  for (const std::uint32_t t : visible)
    distance[t] = distance_to(view, things[t].centre) - things[t].radius;
  std::stable_sort(visible.begin(), visible.end(), [&distance](std::uint32_t a, std::uint32_t b) {
    return distance[a] < distance[b];
  });
  return visible;
}

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

/// The patches in view at the levels that it chooses, nearest first; `radius_factor`: of their
/// discs, over what the store says.
[[nodiscard]] std::vector<std::uint32_t> find_visible(const PatchStore& store, const View& view,
                                                      double radius_factor = 1.0);

/// Of those, the ones near enough for sprites beyond OpenGL's largest point (pixels); `radius`: of
/// the widest disc, world units.
[[nodiscard]] std::vector<std::uint32_t> find_near(const PatchStore& store, const View& view,
                                                   const std::vector<std::uint32_t>& visible,
                                                   double radius, double largest_sprite);

/// The radius that no splat of the model exceeds, world units.
[[nodiscard]] double widest_disc(const PatchStore& store);

/// Things of one page.
struct PageShare {
  std::uint32_t page = 0;
  std::vector<std::uint32_t> things;  ///< in the order of the list
};

/// Sorts a list by pages, those first whose things come first. `page_of` names the page of a thing.
template <class PageOf>
[[nodiscard]] std::vector<PageShare> by_page(const std::vector<std::uint32_t>& things,
                                             const PageOf& page_of) {
  std::vector<PageShare> shares;
  std::unordered_map<std::uint32_t, std::size_t> numbers;
  for (const std::uint32_t thing : things) {
    const auto [found, is_new] = numbers.try_emplace(page_of(thing), shares.size());
    if (is_new) shares.push_back({found->first, {}});
    shares[found->second].things.push_back(thing);
  }
  return shares;
}

/// Commands that draw patches, whose records are of one page, `vertices` per sample without
/// indices: 1 for points, 3 for triangles.
[[nodiscard]] std::vector<ArraysCommand> array_commands(const PatchStore& store,
                                                        const std::vector<std::uint32_t>& patches,
                                                        std::uint32_t vertices);

/// The same with a quad per sample, at most kQuadsPerCommand each.
[[nodiscard]] std::vector<ElementsCommand> quad_commands(const PatchStore& store,
                                                         const std::vector<std::uint32_t>& patches);

}  // namespace relief

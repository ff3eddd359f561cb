#include "renderer/view/draw_list.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace relief {

void add_quads(std::uint32_t first, std::uint32_t quads, std::uint32_t instance,
               std::vector<ElementsCommand>& commands) {
  for (std::uint32_t k = 0; k < quads; k += kQuadsPerCommand) {
    const std::uint32_t count = std::min(kQuadsPerCommand, quads - k);
    commands.push_back({6 * count, 1, 0, static_cast<GLint>(4 * (first + k)), instance});
  }
}

std::vector<std::uint32_t> find_visible(const PatchStore& store, const View& view,
                                        double radius_factor) {
  std::vector<std::uint32_t> visible;
  for (const std::uint32_t p : levels_for(store, view)) {
    const StoredPatch& patch = store.patches[p];
    const double radius = patch.radius + (radius_factor - 1.0) * patch.widest_disc;
    if (patch.records.count > 0 && sees_sphere(view, patch.centre, radius)) visible.push_back(p);
  }
  return nearest_first(store.patches, view, std::move(visible));
}

std::vector<std::uint32_t> find_near(const PatchStore& store, const View& view,
                                     const std::vector<std::uint32_t>& visible, double radius,
                                     double largest_sprite) {
  // A sprite is at most as large as a disc of this radius that faces the eye from its nearest
  // point: 2 r / (z - r) / pixel wide at depth z, times sqrt(1 + slope^2) toward the image's
  // corners.
  const double pixel = 2.0 * view.slope_y / view.height;
  const glm::dvec2 corner = glm::abs(view.middle) + glm::dvec2(view.slope_x, view.slope_y);
  const double lean = 1.0 + glm::dot(corner, corner);
  double depth = radius + 2.0 * radius * lean / (pixel * largest_sprite);
  if (view.orthographic) {
    // Seen as large at any depth; a pixel more for rounding. What reaches before the near plane is
    // no sprite either.
    if (2.0 * radius > pixel * (largest_sprite - 1.0)) return visible;
    depth = view.near + 2.0 * radius;
  }
  std::vector<std::uint32_t> near;
  std::copy_if(visible.begin(), visible.end(), std::back_inserter(near), [&](std::uint32_t p) {
    return nearest_depth(view, store.patches[p].centre, store.patches[p].radius) < depth;
  });
  return near;
}

double widest_disc(const PatchStore& store) {
  double widest = 0.0;
  for (const StoredPatch& patch : store.patches) widest = std::max(widest, patch.widest_disc);
  return widest;
}

std::vector<ArraysCommand> array_commands(const PatchStore& store,
                                          const std::vector<std::uint32_t>& patches,
                                          std::uint32_t vertices) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : patches) {
    const RecordRun& run = store.patches[p].records;
    commands.push_back({vertices * run.count, 1, vertices * run.first, p});
  }
  return commands;
}

std::vector<ElementsCommand> quad_commands(const PatchStore& store,
                                           const std::vector<std::uint32_t>& patches) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t p : patches) {
    const RecordRun& run = store.patches[p].records;
    add_quads(run.first, run.count, p, commands);
  }
  return commands;
}

}  // namespace relief

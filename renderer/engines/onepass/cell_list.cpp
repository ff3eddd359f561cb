#include "renderer/engines/onepass/cell_list.h"

#include <utility>

#include "shaders/include/shared.h"

namespace relief::onepass {

std::vector<std::uint32_t> find_parts(const PatchStore& store, const View& view,
                                      const MaterialChoice& materials) {
  std::vector<bool> chosen(store.patches.size(), false);
  for (const std::uint32_t patch : levels_for(store, view))
    chosen[patch] = materials.has(store.patches[patch].material);
  const std::vector<StoredPart>& parts = store.cells->parts;
  std::vector<std::uint32_t> visible;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (chosen[parts[p].patch] && sees_sphere(view, parts[p].centre, parts[p].radius))
      visible.push_back(p);
  }
  return nearest_first(parts, view, std::move(visible));
}

std::vector<ArraysCommand> cell_commands(const CellStore& store,
                                         const std::vector<std::uint32_t>& parts,
                                         std::uint32_t page) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.page != page || part.runs == 0) continue;
    commands.push_back(
        {shared::kRunVertices * part.runs, 1, shared::kRunVertices * part.first_run, p});
  }
  return commands;
}

std::vector<ArraysCommand> edge_commands(const CellStore& store,
                                         const std::vector<std::uint32_t>& parts,
                                         std::uint32_t page) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.page != page || part.edge_runs == 0) continue;
    commands.push_back({shared::kEdgeRunVertices * part.edge_runs, 1,
                        shared::kEdgeRunVertices * (part.first_run + part.runs), p});
  }
  return commands;
}

std::vector<ElementsCommand> rim_commands(const CellStore& store,
                                          const std::vector<std::uint32_t>& parts,
                                          std::uint32_t page) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.page == page) add_quads(part.first_rim, part.rims, p, commands);
  }
  return commands;
}

std::vector<std::uint32_t> find_seams(const PatchStore& store, const View& view,
                                      const MaterialChoice& materials) {
  if (!store.seams) return {};
  const std::vector<StoredSeam>& seams = store.seams->seams;
  std::vector<std::uint32_t> visible;
  for (const StoredInstance& instance : store.instances) {
    if (instance.is_proxy_in(view)) continue;
    for (std::uint32_t s = instance.seams.first; s < instance.seams.first + instance.seams.count;
         ++s) {
      if (seams[s].corners.count > 0 && materials.has(store.patches[seams[s].patch].material) &&
          sees_sphere(view, seams[s].centre, seams[s].radius))
        visible.push_back(s);
    }
  }
  return nearest_first(seams, view, std::move(visible));
}

std::vector<ElementsCommand> seam_commands(const SeamStore& store, const View& view,
                                           const std::vector<std::uint32_t>& seams) {
  std::vector<ElementsCommand> commands;
  commands.reserve(seams.size());
  for (const std::uint32_t s : seams) {
    const StoredSeam& seam = store.seams[s];
    const bool is_coarse = choose_level(view, seam.extent) > 0;
    commands.push_back({seam.corners.count + (is_coarse ? seam.corners.ring : 0), 1,
                        seam.corners.first, 0, seam.number});
  }
  return commands;
}

}  // namespace relief::onepass

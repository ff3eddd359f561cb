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

void leave_out_backs(const PatchStore& store, const View& view, std::vector<std::uint32_t>& parts) {
  std::erase_if(parts, [&](std::uint32_t p) {
    const StoredPart& part = store.cells->parts[p];
    return faces_away(view, part.normals, store.patches[part.patch].axes, part.centre, part.radius);
  });
}

std::vector<ElementsCommand> strip_commands(const CellStore& store,
                                            const std::vector<std::uint32_t>& parts) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.strip > 0) commands.push_back({part.strip, 1, part.first_strip, 0, p});
  }
  return commands;
}

std::vector<ArraysCommand> run_commands(const CellStore& store,
                                        const std::vector<std::uint32_t>& parts) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.runs == 0) continue;
    commands.push_back(
        {shared::kRunVertices * part.runs, 1, shared::kRunVertices * part.first_run, p});
  }
  return commands;
}

std::vector<ArraysCommand> edge_commands(const CellStore& store,
                                         const std::vector<std::uint32_t>& parts) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.edge_runs == 0) continue;
    commands.push_back({shared::kEdgeRunVertices * part.edge_runs, 1,
                        shared::kEdgeRunVertices * (part.first_run + part.runs), p});
  }
  return commands;
}

std::vector<ArraysCommand> border_commands(const CellStore& store,
                                           const std::vector<std::uint32_t>& parts) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    if (part.borders == 0) continue;
    commands.push_back({shared::kBorderVertices * part.borders, 1,
                        shared::kBorderVertices * part.first_border, p});
  }
  return commands;
}

std::vector<ElementsCommand> rim_commands(const CellStore& store,
                                          const std::vector<std::uint32_t>& parts) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t p : parts) {
    const PartBuffers& part = store.parts[p].buffers;
    add_quads(part.first_rim, part.rims, p, commands);
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
      if (!seams[s].blocks.empty() && materials.has(store.patches[seams[s].patch].material) &&
          sees_sphere(view, seams[s].centre, seams[s].radius))
        visible.push_back(s);
    }
  }
  return nearest_first(seams, view, std::move(visible));
}

std::vector<ElementsCommand> seam_commands(const PatchStore& store, const View& view,
                                           const std::vector<std::uint32_t>& seams,
                                           bool without_backs) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t s : seams) {
    const StoredSeam& seam = store.seams->seams[s];
    const StoredPatch& patch = store.patches[seam.patch];
    const bool is_coarse = choose_level(view, seam.extent) > 0;
    for (const SeamBlock& block : seam.blocks) {
      const glm::dvec3 centre =
          patch.origin + patch.axes * (patch.spacing * glm::dvec3(block.centre));
      if (without_backs &&
          faces_away(view, block.normals, patch.axes, centre, patch.spacing * block.radius))
        continue;
      const std::uint32_t count = block.count + (is_coarse ? block.ring : 0);
      if (count > 0) commands.push_back({count, 1, block.first, 0, seam.number});
    }
  }
  return commands;
}

}  // namespace relief::onepass

#include "renderer/engines/onepass/cell_list.h"

#include "shaders/include/shared.h"

namespace relief::onepass {

std::vector<std::uint32_t> find_visible(const CellStore& store, const View& view) {
  return nearest_first(store.parts, view, [&view](const StoredPart& part) {
    return sees_sphere(view, part.centre, part.radius);
  });
}

std::vector<ArraysCommand> cell_commands(const CellStore& store,
                                         const std::vector<std::uint32_t>& parts,
                                         std::uint32_t page) {
  std::vector<ArraysCommand> commands;
  for (const std::uint32_t p : parts) {
    const StoredPart& part = store.parts[p];
    if (part.page != page || part.runs == 0) continue;
    commands.push_back(
        {shared::kRunVertices * part.runs, 1, shared::kRunVertices * part.first_run, p});
  }
  return commands;
}

std::vector<ElementsCommand> rim_commands(const CellStore& store,
                                          const std::vector<std::uint32_t>& parts,
                                          std::uint32_t page) {
  std::vector<ElementsCommand> commands;
  for (const std::uint32_t p : parts) {
    const StoredPart& part = store.parts[p];
    if (part.page == page) add_quads(part.first_rim, part.rims, p, commands);
  }
  return commands;
}

}  // namespace relief::onepass

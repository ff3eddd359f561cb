#include "renderer/engines/onepass/far_models.h"

#include <span>
#include <utility>

#include "shaders/include/shared.h"

namespace relief::onepass {

std::vector<std::uint32_t> find_far(const PatchStore& store, const View& view) {
  if (!store.far) return {};
  std::vector<std::uint32_t> visible;
  std::vector<Sphere> spheres;
  spheres.reserve(store.placements.size());
  for (std::uint32_t p = 0; p < store.placements.size(); ++p) {
    const StoredPlacement& placement = store.placements[p];
    spheres.push_back(placement.model.sphere);
    if (placement.is_far_in(view) &&
        sees_sphere(view, spheres.back().centre, spheres.back().radius))
      visible.push_back(p);
  }
  return nearest_first(spheres, view, std::move(visible));
}

std::vector<ElementsCommand> far_commands(const PatchStore& store, const View& view,
                                          const std::vector<std::uint32_t>& placements) {
  std::vector<ElementsCommand> commands;
  commands.reserve(placements.size());
  for (const std::uint32_t p : placements) {
    const StoredPlacement& placement = store.placements[p];
    const StoredPlacement::Far& far = *placement.far;
    const StoredFarLevel& level =
        store.far->meshes[far.mesh].levels[choose_far_level(view, placement.model)];
    commands.push_back(
        {level.indices, 1, level.first_index, static_cast<GLint>(level.first_vertex), far.number});
  }
  return commands;
}

void draw_far(const Gl& gl, const Program& program, const FarStore& store,
              const std::vector<ElementsCommand>& commands) {
  if (commands.empty()) return;
  const Buffer buffer =
      make_buffer(gl, "draw commands", std::span<const ElementsCommand>(commands));
  gl.UseProgram(program.id());
  gl.BindVertexArray(store.attributes.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_FAR_VERTICES, store.vertices.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_FAR_SOURCES, store.sources ? store.sources->texture.id() : 0);
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                               static_cast<GLsizei>(commands.size()), 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_FAR_VERTICES, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_FAR_SOURCES, 0);
}

}  // namespace relief::onepass

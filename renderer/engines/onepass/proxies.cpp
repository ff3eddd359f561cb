#include "renderer/engines/onepass/proxies.h"

#include <span>
#include <utility>

#include "shaders/include/shared.h"

namespace relief::onepass {

std::vector<std::uint32_t> find_proxies(const PatchStore& store, const View& view) {
  if (!store.proxies) return {};
  std::vector<std::uint32_t> visible;
  std::vector<Sphere> spheres;
  spheres.reserve(store.instances.size());
  for (std::uint32_t p = 0; p < store.instances.size(); ++p) {
    const StoredInstance& instance = store.instances[p];
    spheres.push_back(instance.model.sphere);
    if (instance.is_proxy_in(view) &&
        sees_sphere(view, spheres.back().centre, spheres.back().radius))
      visible.push_back(p);
  }
  return nearest_first(spheres, view, std::move(visible));
}

std::vector<ElementsCommand> proxy_commands(const PatchStore& store, const View& view,
                                            const std::vector<std::uint32_t>& instances) {
  std::vector<ElementsCommand> commands;
  commands.reserve(instances.size());
  for (const std::uint32_t p : instances) {
    const StoredInstance& instance = store.instances[p];
    const StoredInstance::StoredProxy& proxy = *instance.proxy;
    const StoredProxyLevel& level =
        store.proxies->meshes[proxy.mesh].levels[choose_proxy_level(view, instance.model)];
    commands.push_back({level.indices, 1, level.first_index, static_cast<GLint>(level.first_vertex),
                        proxy.number});
  }
  return commands;
}

void draw_proxy_meshes(const Gl& gl, const Program& program, const ProxyStore& store,
                       const std::vector<ElementsCommand>& commands) {
  if (commands.empty()) return;
  const Buffer buffer =
      make_buffer(gl, "draw commands", std::span<const ElementsCommand>(commands));
  gl.UseProgram(program.id());
  gl.BindVertexArray(store.attributes.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_PROXY_VERTICES, store.vertices.texture.id());
  gl.BindTextureUnit(RELIEF_TEXTURE_PROXY_SOURCES, store.sources ? store.sources->texture.id() : 0);
  gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, buffer.id());
  gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                               static_cast<GLsizei>(commands.size()), 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PROXY_VERTICES, 0);
  gl.BindTextureUnit(RELIEF_TEXTURE_PROXY_SOURCES, 0);
}

}  // namespace relief::onepass

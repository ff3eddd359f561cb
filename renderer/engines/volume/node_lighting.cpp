#include "renderer/engines/volume/node_lighting.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/frame/features.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/gl/program.h"
#include "renderer/view/uniforms.h"
#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

/// Squares of nodes with the same z (first node, 0) that hold a texel with w above 0.
std::vector<glm::ivec4> squares_of(std::span<const glm::u16vec4> texels, glm::ivec3 size) {
  constexpr int kSquareSide = shared::kVolumeSquare;
  const glm::ivec2 squares = (glm::ivec2(size) + kSquareSide - 1) / kSquareSide;
  std::vector<glm::ivec4> found;
  std::vector<bool> is_used(static_cast<std::size_t>(squares.x) *
                            static_cast<std::size_t>(squares.y));
  const auto index_of = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(squares.x) +
           static_cast<std::size_t>(x);
  };
  std::size_t texel = 0;
  for (int z = 0; z < size.z; ++z) {
    is_used.assign(is_used.size(), false);
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x, ++texel) {
        if (texels[texel].w != 0) is_used[index_of(x / kSquareSide, y / kSquareSide)] = true;
      }
    }
    for (int y = 0; y < squares.y; ++y) {
      for (int x = 0; x < squares.x; ++x) {
        if (is_used[index_of(x, y)]) found.emplace_back(x * kSquareSide, y * kSquareSide, z, 0);
      }
    }
  }
  return found;
}

shared::VolumeNodes nodes_of(const VolumeFrame& frame, const RegularGrid& grid, float albedo) {
  const glm::dvec3 first = grid.origin + grid.step * glm::dvec3(frame.box.low);
  shared::VolumeNodes nodes{};
  nodes.from_eye = glm::vec4(glm::dvec4(first - frame.view.eye, 0.0));
  nodes.step_x = glm::vec4(glm::dvec4(grid.step[0], 0.0));
  nodes.step_y = glm::vec4(glm::dvec4(grid.step[1], 0.0));
  nodes.step_z = glm::vec4(glm::dvec4(grid.step[2], 0.0));
  nodes.size = glm::vec4(glm::vec3(frame.box.size()), albedo);
  return nodes;
}

}  // namespace

bool NodeLighting::can_light(const RenderSettings& settings) {
  const Features features = material_features(settings);
  constexpr std::uint32_t kLights = RELIEF_FEATURE_LIT | RELIEF_FEATURE_POINT_LIGHTS;
  if (!features.has(RELIEF_FEATURE_LIT) || features.without(kLights).bits != 0) return false;
  auto found = programs_.find(features);
  if (found == programs_.end()) {
    auto made = make_program(gl_, "volume nodes", "volume/node.vert", "volume/node.frag", features);
    found =
        programs_.emplace(features, made ? std::optional<Program>(*std::move(made)) : std::nullopt)
            .first;
  }
  return found->second.has_value();
}

NodeLighting::Kept NodeLighting::make_kept(const VolumeFrame& frame,
                                           const GridTextures& nodes) const {
  const glm::uvec3 size = frame.box.size();
  Texture lit = make_grid_texture(gl_, "lit nodes", GL_RGBA16F, size);
  Framebuffer framebuffer = make_framebuffer(gl_, "lit nodes", nullptr, {{0, &lit}});
  const std::array<GLfloat, 4> nothing{};
  gl_.ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, nothing.data());
  const std::vector<glm::ivec4> squares = squares_of(nodes.texels, glm::ivec3(size));
  return {std::move(lit), std::move(framebuffer),
          make_table<glm::ivec4>(gl_, "squares of nodes", GL_RGBA32I, squares),
          static_cast<GLsizei>(squares.size())};
}

const Texture& NodeLighting::light(const VolumeFrame& frame, const RegularGrid& grid,
                                   const GridTextures& nodes, PassTimer& timer) {
  if (!kept_) kept_ = make_kept(frame, nodes);
  const Program& program = *programs_.at(material_features(frame.settings));
  const shared::VolumeNodes shading = nodes_of(frame, grid, nodes.colour);
  const shared::Frame lights = make_frame(frame.view, 0.0, frame.settings.lights);
  const Buffer shadings =
      make_buffer(gl_, "volume nodes", std::span<const shared::VolumeNodes>(&shading, 1));
  const Buffer frames = make_buffer(gl_, "lights", std::span<const shared::Frame>(&lights, 1));
  const glm::uvec3 size = frame.box.size();
  const ScopedPass pass(gl_, timer, "volume nodes");
  gl_.BindFramebuffer(GL_FRAMEBUFFER, kept_->framebuffer.id());
  gl_.Viewport(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y));
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_NODES, shadings.id());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_FRAME, frames.id());
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, nodes.nodes.id());
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, nodes.normals->id());
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SQUARES, kept_->squares.texture.id());
  gl_.UseProgram(program.id());
  gl_.BindVertexArray(nothing_.id());
  gl_.DrawArrays(GL_TRIANGLES, 0, 6 * kept_->count);
  gl_.BindVertexArray(0);
  gl_.UseProgram(0);
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SQUARES, 0);
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, 0);
  gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, 0);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_FRAME, 0);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_NODES, 0);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  return kept_->lit;
}

}  // namespace relief::volume

#include "renderer/engines/volume/grid_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/engines/volume/block_distances.h"
#include "renderer/engines/volume/grid_rays.h"
#include "renderer/engines/volume/rule.h"
#include "renderer/gl/program.h"
#include "renderer/volume/splat_order.h"

namespace relief::volume {
namespace {

using Texel = glm::u16vec4;

/// What is kept from frame to frame: of the cloud, and of colours.
struct GridTextures {
  Texture nodes;
  Texture distances;
  std::optional<Texture> normals = {};
  float extinction = 0.0F;  ///< of a texel's 1
  float colour = 1.0F;
  std::vector<Texel> texels = {};
  std::vector<glm::vec3> colours = {};  ///< those of the texels
};

std::size_t texel_of(const KernelCloud& cloud, const NodeBox& box, std::size_t k) {
  const glm::uvec3 in_box = cloud.node(k) - box.low;
  const glm::uvec3 size = box.size();
  return in_box.x + std::size_t{size.x} * (in_box.y + std::size_t{size.y} * in_box.z);
}

Texture make_grid_texture(const Gl& gl, const char* label, GLenum format, glm::uvec3 size) {
  Texture texture(gl, label, GLenum{GL_TEXTURE_3D});
  gl.TextureStorage3D(texture.id(), 1, format, static_cast<GLsizei>(size.x),
                      static_cast<GLsizei>(size.y), static_cast<GLsizei>(size.z));
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

void upload(const Gl& gl, const Texture& texture, glm::uvec3 size, GLenum format, GLenum type,
            const void* texels) {
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TextureSubImage3D(texture.id(), 0, 0, 0, 0, static_cast<GLsizei>(size.x),
                       static_cast<GLsizei>(size.y), static_cast<GLsizei>(size.z), format, type,
                       texels);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

std::uint16_t share_of(float value, float of) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value / of, 0.0F, 1.0F) * 65535.0F));
}

class GridDrawing final : public VolumeDrawing {
 public:
  GridDrawing(const Gl& gl, const ScalarVolume& volume)
      : gl_(gl), volume_(volume), nothing_(gl, "no attributes") {}

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& /*progress*/) override {
    RELIEF_TRY_ASSIGN(const Program* const program, program_for(frame.features));
    prepare_cloud(frame);
    upload_colours(frame);
    RELIEF_TRY(check_errors(gl_, "the volume"));
    const auto& grid = std::get<RegularGrid>(volume_.placement);
    shared::VolumeGrid rays = grid_rays(frame, grid).value();
    rays.place_x.w = textures_->extinction;
    rays.place_y.w = textures_->colour;
    shared::VolumeRule rule = shader_rule(frame);
    rule.limits.z = kSeenThrough;
    const Buffer rules =
        make_buffer(gl_, "volume rule", std::span<const shared::VolumeRule>(&rule, 1));
    const Buffer grids =
        make_buffer(gl_, "volume grid", std::span<const shared::VolumeGrid>(&rays, 1));
    const ScopedPass pass(gl_, timer, "volume sheets");
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, grids.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, textures_->nodes.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, textures_->distances.id());
    if (textures_->normals)
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, textures_->normals->id());
    draw_screen(gl_, targets, *program, rules, nothing_);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, 0);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, 0);
    return {};
  }

 private:
  /// Where a ray ends: what is behind adds less than an 8-bit image can show.
  static constexpr float kSeenThrough = 1e-4F;

  /// Makes what depends on the kernels, if they are others than before.
  void prepare_cloud(const VolumeFrame& frame) {
    const KernelCloud& cloud = frame.cloud;
    const bool needs_normals = frame.features.has(RELIEF_FEATURE_OUT_NORMAL);
    if (textures_ && frame.cloud_version == version_ && (textures_->normals || !needs_normals))
      return;
    version_ = frame.cloud_version;
    const glm::uvec3 size = frame.box.size();
    const glm::uvec3 blocks = (size - 1U) / std::uint32_t{shared::kVolumeBlock} + 1U;
    textures_.emplace(
        GridTextures{.nodes = make_grid_texture(gl_, "nodes", GL_RGBA16, size),
                     .distances = make_grid_texture(gl_, "distances", GL_R8UI, blocks)});
    const double space = std::abs(glm::determinant(std::get<RegularGrid>(volume_.placement).step));
    const float most = *std::max_element(cloud.weights.begin(), cloud.weights.end());
    textures_->extinction = static_cast<float>(
        std::min(static_cast<double>(most) / space, static_cast<double>(kLargest)));
    textures_->texels.assign(std::size_t{size.x} * size.y * size.z, Texel(0));
    std::vector<glm::i8vec4> normals(needs_normals ? textures_->texels.size() : 0);
    for (std::size_t k = 0; k < cloud.count(); ++k) {
      const std::size_t texel = texel_of(cloud, frame.box, k);
      textures_->texels[texel].w = share_of(cloud.weights[k], most);
      if (needs_normals)
        normals[texel] = glm::i8vec4(glm::round(127.0F * glm::vec4(cloud.normals[k], 0.0F)));
    }
    upload(gl_, textures_->distances, blocks, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
           block_distances(textures_->texels, size).data());
    if (!needs_normals) return;
    textures_->normals = make_grid_texture(gl_, "node normals", GL_RGBA8_SNORM, size);
    upload(gl_, *textures_->normals, size, GL_RGBA, GL_BYTE, normals.data());
  }

  void upload_colours(const VolumeFrame& frame) {
    const std::span<const glm::vec3> colours = frame.colours;
    if (std::equal(colours.begin(), colours.end(), textures_->colours.begin(),
                   textures_->colours.end()))
      return;
    textures_->colours.assign(colours.begin(), colours.end());
    float most = 0.0F;
    for (const glm::vec3& colour : colours) most = std::max({most, colour.x, colour.y, colour.z});
    most = std::clamp(most, 1e-30F, kLargest);
    textures_->colour = most;
    tbb::parallel_for(std::size_t{0}, colours.size(), [&](std::size_t k) {
      Texel& texel = textures_->texels[texel_of(frame.cloud, frame.box, k)];
      texel.x = share_of(colours[k].x, most);
      texel.y = share_of(colours[k].y, most);
      texel.z = share_of(colours[k].z, most);
    });
    upload(gl_, textures_->nodes, frame.box.size(), GL_RGBA, GL_UNSIGNED_SHORT,
           textures_->texels.data());
  }

  Result<const Program*> program_for(Features features) {
    auto found = programs_.find(features);
    if (found == programs_.end()) {
      RELIEF_TRY_ASSIGN(Program made, make_program(gl_, "volume sheets", "environment/screen.vert",
                                                   "volume/grid.frag", features));
      found = programs_.emplace(features, std::move(made)).first;
    }
    return &found->second;
  }

  const Gl& gl_;
  const ScalarVolume& volume_;
  VertexArray nothing_;
  std::map<Features, Program> programs_;
  std::optional<GridTextures> textures_;
  std::uint64_t version_ = 0;
};

}  // namespace

bool is_for_grid(const Gl& gl, const VolumeFrame& frame, const ScalarVolume* volume) {
  if (volume == nullptr) return false;
  const auto* const grid = std::get_if<RegularGrid>(&volume->placement);
  const KernelCloud& cloud = frame.cloud;
  if (grid == nullptr || cloud.variances.size() != 1 || cloud.count() == 0) return false;
  if (visibility_of(cloud, frame.settings.volume.visibility) != VolumeVisibility::Sheet)
    return false;
  const auto most = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_3D_TEXTURE_SIZE));
  const glm::uvec3 size = frame.box.size();
  if (std::max({size.x, size.y, size.z}) > most) return false;
  return grid_rays(frame, *grid).has_value();
}

std::unique_ptr<VolumeDrawing> make_grid_drawing(const Gl& gl, const ScalarVolume& volume) {
  return std::make_unique<GridDrawing>(gl, volume);
}

}  // namespace relief::volume

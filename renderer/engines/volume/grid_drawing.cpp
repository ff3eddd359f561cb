#include "renderer/engines/volume/grid_drawing.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "renderer/engines/volume/block_distances.h"
#include "renderer/engines/volume/grid_rays.h"
#include "renderer/engines/volume/grid_textures.h"
#include "renderer/engines/volume/node_lighting.h"
#include "renderer/engines/volume/rule.h"
#include "renderer/gl/program.h"
#include "renderer/volume/splats/splat_order.h"

namespace relief::volume {
namespace {

/// sheet_distances() of sheets across that axis.
struct SheetDistances {
  glm::uvec3 axes;
  Texture distances;
};

class Drawing final : public GridDrawing {
 public:
  Drawing(const Gl& gl, const ScalarVolume& volume)
      : gl_(gl), volume_(volume), nothing_(gl, "no attributes"), lighting_(gl) {}

  bool lights_nodes(const RenderSettings& settings) override {
    return lighting_.can_light(settings);
  }

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& /*progress*/) override {
    RELIEF_TRY_ASSIGN(const Program* const program, program_for(frame.features));
    const auto& grid = std::get<RegularGrid>(volume_.placement);
    const bool is_lit_here = frame.colours.empty();
    prepare(frame, grid, is_lit_here);
    RELIEF_TRY(check_errors(gl_, "the volume"));
    shared::VolumeGrid rays = grid_rays(frame, grid).value();
    prepare_sheets(frame, rays);
    rays.place_x.w = textures_->extinction;
    rays.place_y.w = is_lit_here ? 1.0F : textures_->colour;
    shared::VolumeRule rule = shader_rule(frame);
    rule.limits.z = kSeenThrough;
    const Buffer rules =
        make_buffer(gl_, "volume rule", std::span<const shared::VolumeRule>(&rule, 1));
    const Buffer grids =
        make_buffer(gl_, "volume grid", std::span<const shared::VolumeGrid>(&rays, 1));
    const Texture& nodes =
        is_lit_here ? lighting_.light(frame, grid, *textures_, timer) : textures_->nodes;
    const ScopedPass pass(gl_, timer, "volume sheets");
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, grids.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, nodes.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, textures_->distances.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEET_DISTANCES, sheets_->distances.id());
    if (textures_->normals)
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, textures_->normals->id());
    draw_screen(gl_, targets, *program, rules, nothing_);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEET_DISTANCES, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, 0);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, 0);
    return {};
  }

 private:
  /// Where a ray ends. What is behind is taken to look like what is seen, so that this bounds the
  /// error of a colour's share, too.
  static constexpr float kSeenThrough = 1e-3F;

  /// Makes what depends on the kernels, if they are others than before, and sets colours.
  void prepare(const VolumeFrame& frame, const RegularGrid& grid, bool is_lit_here) {
    const bool needs_normals = is_lit_here || frame.features.has(RELIEF_FEATURE_OUT_NORMAL);
    if (!textures_ || frame.cloud_version != version_ || (needs_normals && !textures_->normals)) {
      textures_ = make_grid_textures(gl_, frame, grid, needs_normals);
      version_ = frame.cloud_version;
      has_own_colours_ = false;
      lighting_.reset();
      sheets_.reset();
    }
    if (!is_lit_here) {
      set_colours(gl_, frame, frame.colours, *textures_);
    } else if (!has_own_colours_) {
      set_colours(gl_, frame, frame.cloud.colours, *textures_);
    }
    has_own_colours_ = is_lit_here;
  }

  /// Makes what depends on the axis across the sheets, if it is another one than before.
  void prepare_sheets(const VolumeFrame& frame, const shared::VolumeGrid& rays) {
    const auto axis = [](glm::ivec4 unit) { return unit.x != 0 ? 0U : unit.y != 0 ? 1U : 2U; };
    const glm::uvec3 axes(axis(rays.u), axis(rays.v), axis(rays.w));
    if (sheets_ && sheets_->axes == axes) return;
    const auto squares = [](int nodes) {
      return static_cast<std::uint32_t>((nodes - 1) / shared::kVolumeSheetBlock + 1);
    };
    const glm::uvec3 size(squares(rays.u.w), squares(rays.v.w), rays.w.w);
    sheets_.emplace(
        SheetDistances{axes, make_grid_texture(gl_, "distances in sheets", GL_R8UI, size)});
    upload_grid(gl_, sheets_->distances, size, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                sheet_distances(textures_->texels, frame.box.size(), axes).data());
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
  NodeLighting lighting_;
  std::optional<GridTextures> textures_;
  std::optional<SheetDistances> sheets_;
  bool has_own_colours_ = false;  ///< the textures: the kernels' colours, which are to be lit
  std::uint64_t version_ = 0;
};

}  // namespace

bool is_for_grid(const Gl& gl, const VolumeFrame& frame, const ScalarVolume* volume) {
  if (volume == nullptr) return false;
  const auto* const grid = std::get_if<RegularGrid>(&volume->placement);
  const KernelCloud& cloud = frame.cloud;
  const bool is_uniform = cloud.variances.size() == 1 && cloud.is_surface.empty();
  if (grid == nullptr || !is_uniform || cloud.count() == 0) return false;
  if (cloud.size != volume->size) return false;  // coarser kernels
  if (visibility_of(cloud, frame.settings.volume.visibility) != VolumeVisibility::Sheet)
    return false;
  const auto most = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_3D_TEXTURE_SIZE));
  const glm::uvec3 size = frame.box.size();
  if (std::max({size.x, size.y, size.z}) > most) return false;
  return grid_rays(frame, *grid).has_value();
}

std::unique_ptr<GridDrawing> make_grid_drawing(const Gl& gl, const ScalarVolume& volume) {
  return std::make_unique<Drawing>(gl, volume);
}

}  // namespace relief::volume

#include "renderer/engines/volume/sheet_drawing.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "renderer/engines/volume/grid_rays.h"
#include "renderer/engines/volume/grid_textures.h"
#include "renderer/engines/volume/rule.h"
#include "renderer/engines/volume/sheet_atlas.h"
#include "renderer/engines/volume/sheet_view.h"
#include "renderer/frame/attachments.h"
#include "renderer/frame/features.h"
#include "renderer/frame/targets.h"
#include "renderer/gl/program.h"
#include "renderer/view/uniforms.h"

namespace relief::volume {
namespace {

/// Reaches are rounded up to this, so that squares are seldom found anew.
constexpr int kReachStep = 4;

/// A texture of all sheets, and a framebuffer to draw into it.
struct Sheets {
  Texture texture;
  Framebuffer framebuffer;
};

/// Squares of sheets as a table.
struct Tiles {
  Table table;
  GLsizei count = 0;
};

/// What is kept while the cloud, the axis of the sheets and the rounded reach stay the same.
struct Prefilter {
  glm::ivec3 axes;
  int reach = 0;
  SheetAtlas atlas;
  Sheets shaded;
  Sheets along_u;
  Sheets widened;
  Tiles shaded_tiles;
  Tiles along_u_tiles;
  Tiles widened_tiles;
};

Sheets make_sheets(const Gl& gl, const char* label, const SheetAtlas& atlas) {
  Texture texture = make_attachment(gl, label, GL_RGBA16F, static_cast<std::uint32_t>(atlas.texels.x),
                                    static_cast<std::uint32_t>(atlas.texels.y));
  Framebuffer framebuffer = make_framebuffer(gl, label, nullptr, {{0, &texture}});
  const std::array<GLfloat, 4> nothing{};
  gl.ClearNamedFramebufferfv(framebuffer.id(), GL_COLOR, 0, nothing.data());
  return {std::move(texture), std::move(framebuffer)};
}

Tiles make_tiles(const Gl& gl, const char* label, const SheetTiles& tiles) {
  return {make_table<glm::ivec4>(gl, label, GL_RGBA32I, tiles), static_cast<GLsizei>(tiles.size())};
}

class Drawing final : public SheetDrawing {
 public:
  Drawing(const Gl& gl, const ScalarVolume& volume)
      : gl_(gl),
        grid_(std::get<RegularGrid>(volume.placement)),
        nothing_(gl, "no attributes"),
        largest_(static_cast<int>(largest_target(gl))) {}

  bool is_for(const VolumeFrame& frame) const override {
    if (frame.features.has(RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH)) return false;
    const auto rays = grid_rays(frame, grid_);
    if (!rays || rays->camera.z != 0.0F) return false;
    const auto atlas = atlas_for(frame, axes_of(*rays));
    return atlas && sheet_view(frame, grid_, *rays, *atlas);
  }

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& /*progress*/) override {
    const Features material = shades_nodes(frame.settings) ? material_features(frame.settings) : Features();
    RELIEF_TRY_ASSIGN(const Program* const shade,
                      program_for(shade_, "volume nodes", "volume/sheet.vert", "volume/sheet_shade.frag", material));
    RELIEF_TRY_ASSIGN(const Program* const widen,
                      program_for(widen_, "volume kernels", "volume/sheet.vert", "volume/sheet_widen.frag", {}));
    RELIEF_TRY_ASSIGN(const Program* const read, program_for(read_, "volume sheets", "environment/screen.vert",
                                                             "volume/grid_sheets.frag", {}));
    prepare_nodes(frame, material.has(RELIEF_FEATURE_LIT));
    shared::VolumeGrid rays = grid_rays(frame, grid_).value();
    const glm::ivec3 axes = axes_of(rays);
    const SheetAtlas atlas = atlas_for(frame, axes).value();
    const shared::VolumeSheets sheets = sheet_view(frame, grid_, rays, atlas).value();
    prepare_sheets(frame, axes, atlas, static_cast<int>(sheets.kernel.z));
    RELIEF_TRY(check_errors(gl_, "the volume"));
    rays.place_x.w = textures_->extinction;
    rays.place_y.w = textures_->colour;
    shared::VolumeRule rule = shader_rule(frame);
    rule.limits.z = kSeenThrough;
    const shared::Frame lights = make_frame(frame.view, 0.0, frame.settings.lights);
    const Buffer rules =
        make_buffer(gl_, "volume rule", std::span<const shared::VolumeRule>(&rule, 1));
    const Buffer grids =
        make_buffer(gl_, "volume grid", std::span<const shared::VolumeGrid>(&rays, 1));
    const Buffer views =
        make_buffer(gl_, "volume sheets", std::span<const shared::VolumeSheets>(&sheets, 1));
    const Buffer frames = make_buffer(gl_, "lights", std::span<const shared::Frame>(&lights, 1));
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, grids.id());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_SHEETS, views.id());
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_FRAME, frames.id());
    const char* const stop_text = getenv("STOP");
    const int stop = stop_text != nullptr ? atoi(stop_text) : 9;
    gl_.Enable(GL_PROGRAM_POINT_SIZE);
    if (stop > 0) {
      const ScopedPass pass(gl_, timer, "volume nodes");
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, textures_->nodes.id());
      if (textures_->normals)
        gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, textures_->normals->id());
      draw_tiles(*shade, kept_->shaded_tiles, kept_->shaded, nullptr);
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NORMALS, 0);
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_NODES, 0);
    }
    if (stop > 1) {
      const ScopedPass pass(gl_, timer, "volume kernels along u");
      gl_.ProgramUniform1i(widen->id(), RELIEF_VOLUME_UNIFORM_AXIS, 0);
      draw_tiles(*widen, kept_->along_u_tiles, kept_->along_u, &kept_->shaded.texture);
    }
    if (stop > 2) {
      const ScopedPass pass(gl_, timer, "volume kernels along v");
      gl_.ProgramUniform1i(widen->id(), RELIEF_VOLUME_UNIFORM_AXIS, 1);
      draw_tiles(*widen, kept_->widened_tiles, kept_->widened, &kept_->along_u.texture);
    }
    gl_.Disable(GL_PROGRAM_POINT_SIZE);
    if (stop > 3) {
      const ScopedPass pass(gl_, timer, "volume sheets");
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, textures_->distances.id());
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEETS, kept_->widened.texture.id());
      draw_screen(gl_, targets, *read, rules, nothing_);
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEETS, 0);
      gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_DISTANCES, 0);
    }
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_FRAME, 0);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_SHEETS, 0);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_VOLUME_BIND_GRID, 0);
    return {};
  }

 private:
  /// Where a ray ends: what is behind adds less than an 8-bit image can show.
  static constexpr float kSeenThrough = 1e-4F;

  using Programs = std::map<Features, Program>;

  [[nodiscard]] std::optional<SheetAtlas> atlas_for(const VolumeFrame& frame, glm::ivec3 axes) const {
    const glm::ivec3 size(frame.box.size());
    return sheet_atlas({size[axes.x], size[axes.y], size[axes.z]}, largest_);
  }

  void prepare_nodes(const VolumeFrame& frame, bool needs_normals) {
    const bool is_new = !textures_ || frame.cloud_version != version_ ||
                        (needs_normals && !textures_->normals);
    if (is_new) {
      textures_ = make_grid_textures(gl_, frame, grid_, needs_normals);
      version_ = frame.cloud_version;
      kept_.reset();
    }
    if (!frame.colours.empty()) {
      set_colours(gl_, frame, frame.colours, *textures_);
      has_own_colours_ = false;
    } else if (is_new || !has_own_colours_) {
      set_colours(gl_, frame, frame.cloud.colours, *textures_);
      has_own_colours_ = true;
    }
  }

  void prepare_sheets(const VolumeFrame& frame, glm::ivec3 axes, const SheetAtlas& atlas, int reach) {
    const int rounded = (reach + kReachStep - 1) / kReachStep * kReachStep;
    if (kept_ && kept_->axes == axes && kept_->reach == rounded) return;
    kept_.reset();
    const auto tiles = [&](const char* label, glm::ivec2 over) {
      return make_tiles(gl_, label,
                        sheet_tiles(textures_->texels, glm::ivec3(frame.box.size()), axes, over));
    };
    kept_.emplace(Prefilter{.axes = axes,
                            .reach = rounded,
                            .atlas = atlas,
                            .shaded = make_sheets(gl_, "shaded sheets", atlas),
                            .along_u = make_sheets(gl_, "sheets, widened along u", atlas),
                            .widened = make_sheets(gl_, "widened sheets", atlas),
                            .shaded_tiles = tiles("shaded squares", {0, 0}),
                            .along_u_tiles = tiles("squares along u", {rounded, 0}),
                            .widened_tiles = tiles("widened squares", {rounded, rounded})});
    if (getenv("SHOW"))
      fprintf(stderr, "atlas %d x %d, squares %d %d %d reach %d %d\n", atlas.texels.x, atlas.texels.y,
              kept_->shaded_tiles.count, kept_->along_u_tiles.count, kept_->widened_tiles.count, reach,
              rounded);
    gl_.TextureParameteri(kept_->widened.texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TextureParameteri(kept_->widened.texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }

  void draw_tiles(const Program& program, const Tiles& tiles, const Sheets& into, const Texture* from) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, into.framebuffer.id());
    gl_.Viewport(0, 0, kept_->atlas.texels.x, kept_->atlas.texels.y);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_TILES, tiles.table.texture.id());
    if (from != nullptr) gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEETS, from->id());
    gl_.UseProgram(program.id());
    gl_.BindVertexArray(nothing_.id());
    gl_.DrawArrays(GL_POINTS, 0, tiles.count);
    gl_.BindVertexArray(0);
    gl_.UseProgram(0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SHEETS, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_TILES, 0);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
  }

  Result<const Program*> program_for(Programs& programs, const char* label, const char* vertex,
                                     const char* fragment, Features features) {
    auto found = programs.find(features);
    if (found == programs.end()) {
      RELIEF_TRY_ASSIGN(Program made, make_program(gl_, label, vertex, fragment, features));
      found = programs.emplace(features, std::move(made)).first;
    }
    return &found->second;
  }

  const Gl& gl_;
  const RegularGrid& grid_;
  VertexArray nothing_;
  int largest_;
  Programs shade_;
  Programs widen_;
  Programs read_;
  std::optional<GridTextures> textures_;
  bool has_own_colours_ = false;  ///< the textures', not shaded ones
  std::uint64_t version_ = 0;
  std::optional<Prefilter> kept_;
};

}  // namespace

bool shades_nodes(const RenderSettings& settings) {
  const Features features = material_features(settings);
  return features.without(RELIEF_FEATURE_LIT | RELIEF_FEATURE_POINT_LIGHTS).bits == 0;
}

std::unique_ptr<SheetDrawing> make_sheet_drawing(const Gl& gl, const ScalarVolume& volume) {
  return std::make_unique<Drawing>(gl, volume);
}

}  // namespace relief::volume

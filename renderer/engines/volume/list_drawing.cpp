#include "renderer/engines/volume/list_drawing.h"

#include <map>
#include <utility>
#include <vector>

#include "renderer/engines/volume/rule.h"
#include "renderer/engines/volume/shader_splats.h"
#include "renderer/gl/program.h"
#include "renderer/volume/splats/placement.h"
#include "renderer/volume/splats/tile_lists.h"

namespace relief::volume {
namespace {

static_assert(shared::kVolumeTile == kTile);

/// The tiles' lists one after the other, and where each begins.
struct Lists {
  std::vector<glm::uvec2> entries;
  std::vector<std::uint32_t> starts;
};

Lists shader_lists(const TileLists& lists, std::size_t tiles) {
  Lists all;
  all.starts.push_back(0);
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::span<const OrderedSplat> list = lists.list(t);
    for (std::size_t e = 0; e < list.size(); ++e) {
      const bool is_last = e + 1 == list.size() || list[e + 1].group != list[e].group;
      all.entries.emplace_back(list[e].splat, list[e].group << 1U | (is_last ? 1U : 0U));
    }
    all.starts.push_back(static_cast<std::uint32_t>(all.entries.size()));
  }
  return all;
}

class ListDrawing final : public VolumeDrawing {
 public:
  explicit ListDrawing(const Gl& gl) : gl_(gl), nothing_(gl, "no attributes") {}

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& progress) override {
    RELIEF_TRY_ASSIGN(const Program* const program, program_for(frame.features));
    const VolumeSettings& chosen = frame.settings.volume;
    const std::vector<PlacedSplat> placed =
        place_splats(frame.cloud, frame.view, frame.footprints, progress);
    const SplatOrder order =
        order_splats(frame.cloud, placed, visibility_of(frame.cloud, chosen.visibility),
                     ray_camera(frame.view), frame.spacing);
    const Tiling tiling{frame.view.width, frame.view.height};
    const Lists lists = shader_lists(TileLists(tiling, placed, order), tiling.count());
    const auto most = static_cast<std::size_t>(get_limit(gl_, GL_MAX_TEXTURE_BUFFER_SIZE));
    if (lists.entries.size() > most) {
      return make_error(
          "{} kernels in {} places are more than this OpenGL can draw at once; --engine "
          "volume-reference can",
          placed.size(), lists.entries.size());
    }
    if (progress.cancelled()) return interrupted_error();

    shared::VolumeRule rule = shader_rule(frame);
    if (order.has_slabs) {
      rule.image.w |= RELIEF_VOLUME_SLABS;
      rule.slabs = {order.first_depth, order.thickness, 0.0, 0.0};
    }
    const std::vector<shared::VolumeSplat> splats = shader_splats(frame, placed);
    RELIEF_TRY_ASSIGN(const Table splat_table, make_splat_table(gl_, splats));
    const Table entries = make_table<glm::uvec2>(gl_, "tile lists", GL_RG32UI, lists.entries);
    const Table starts = make_table<std::uint32_t>(gl_, "tile starts", GL_R32UI, lists.starts);
    const Buffer rules =
        make_buffer(gl_, "volume rule", std::span<const shared::VolumeRule>(&rule, 1));
    const ScopedPass pass(gl_, timer, "volume lists");
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SPLATS, splat_table.texture.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_ENTRIES, entries.texture.id());
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_STARTS, starts.texture.id());
    draw_screen(gl_, targets, *program, rules, nothing_);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_STARTS, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_ENTRIES, 0);
    gl_.BindTextureUnit(RELIEF_VOLUME_TEXTURE_SPLATS, 0);
    return {};
  }

 private:
  Result<const Program*> program_for(Features features) {
    auto found = programs_.find(features);
    if (found == programs_.end()) {
      RELIEF_TRY_ASSIGN(Program made, make_program(gl_, "volume lists", "environment/screen.vert",
                                                   "volume/list.frag", features));
      found = programs_.emplace(features, std::move(made)).first;
    }
    return &found->second;
  }

  const Gl& gl_;
  VertexArray nothing_;
  std::map<Features, Program> programs_;
};

}  // namespace

std::unique_ptr<VolumeDrawing> make_list_drawing(const Gl& gl) {
  return std::make_unique<ListDrawing>(gl);
}

}  // namespace relief::volume

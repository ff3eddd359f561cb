#include "renderer/engines/volume/cpu/cpu_drawing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <vector>

#include "renderer/engines/volume/cpu/placer.h"
#include "renderer/engines/volume/cpu/tiles.h"
#include "renderer/gl/software.h"
#include "renderer/volume/splats/kernel_order.h"
#include "renderer/volume/splats/splat_order.h"

namespace relief::volume {
namespace {

using cpu::Piece;
using cpu::Tiles;

/// Kernels that are placed before what they hide is known, and as one piece of work.
constexpr std::size_t kBatch = 65536;
constexpr std::size_t kPiece = 2048;

/// Kernels front to back, in batches, until nothing more is seen.
class Drawer {
 public:
  Drawer(const VolumeFrame& frame, const KernelOrder& order, Tiles& tiles)
      : order_(order), tiles_(tiles), placer_(frame) {}

  void draw(const Progress& progress) {
    for (std::size_t first = 0; first < order_.groups() && tiles_.is_any_open();) {
      if (progress.cancelled()) return;
      std::size_t end = first + 1;
      while (end < order_.groups() && order_.starts[end] - order_.starts[first] < kBatch) ++end;
      place(first, end);
      tiles_.put_behind(batch_, progress);
      first = end;
    }
  }

 private:
  /// Finds what may be seen of some groups.
  void place(std::size_t first, std::size_t end) {
    const std::size_t begin = order_.starts[first];
    const std::size_t count = order_.starts[end] - begin;
    if (batch_.splats.size() < count) batch_.splats.resize(count);
    if (tiles_.needs_surfaces()) batch_.surfaces.resize(batch_.splats.size());
    batch_.pieces.resize((count + kPiece - 1) / kPiece);
    tbb::parallel_for(std::size_t{0}, batch_.pieces.size(), [&](std::size_t p) {
      const std::size_t from = begin + p * kPiece;
      const std::size_t to = std::min(from + kPiece, begin + count);
      auto group = static_cast<std::size_t>(std::ranges::upper_bound(order_.starts, from) -
                                            order_.starts.begin() - 1);
      const auto part_of = [&](auto& all) {
        return all.empty() ? std::span(all) : std::span(all).subspan(p * kPiece, to - from);
      };
      Piece& piece = batch_.pieces[p];
      piece = Piece(part_of(batch_.splats), part_of(batch_.surfaces));
      for (std::size_t i = from; i < to; ++group) {
        const std::size_t group_end = std::min<std::size_t>(to, order_.starts[group + 1]);
        placer_.place(std::span(order_.kernels).subspan(i, group_end - i),
                      static_cast<std::uint32_t>(group), tiles_, piece);
        i = group_end;
      }
    });
  }

  const KernelOrder& order_;
  Tiles& tiles_;
  cpu::Placer placer_;
  cpu::Batch batch_;
};

class TiledDrawing final : public CpuDrawing {
 public:
  explicit TiledDrawing(const Gl& gl) : gl_(gl) {}

  Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
              const Progress& progress) override {
    const ScopedPass pass(gl_, timer, "volume on the CPU");
    const Tiles tiles = composited(frame, targets.surface.has_value(), progress);
    if (progress.cancelled()) return interrupted_error();
    upload(targets, targets.colour, tiles.colours());
    if (targets.surface) upload(targets, *targets.surface, tiles.surfaces());
    return {};
  }

  [[nodiscard]] float depth_of_pixel(const VolumeFrame& frame) override {
    assert(frame.view.width == 1 && frame.view.height == 1);
    const Progress silent;
    return composited(frame, true, silent).surfaces().front().w;
  }

 private:
  Tiles composited(const VolumeFrame& frame, bool has_surfaces, const Progress& progress) {
    const RayCamera camera = ray_camera(frame.view);
    const bool has_sheets =
        visibility_of(frame.cloud, frame.settings.volume.visibility) == VolumeVisibility::Sheet;
    const KernelOrder order = has_sheets ? order_by_sheets(sheets_for(frame, camera), camera)
                                         : order_by_depth(frame.cloud, camera);
    Tiles tiles(frame.view.width, frame.view.height,
                {.compositing = composite_rule(frame.settings.volume, frame.cloud.weight),
                 .has_layers = has_sheets,
                 .has_surfaces = has_surfaces,
                 .limits = frame.limits});
    Drawer(frame, order, tiles).draw(progress);
    return tiles;
  }

  /// Made when they are first needed, and again when the kernels are others.
  const KernelSheets& sheets_for(const VolumeFrame& frame, const RayCamera& camera) {
    if (frame.cloud_version != version_) sheets_ = {};
    version_ = frame.cloud_version;
    const glm::length_t axis = sheet_axis(frame.cloud, camera);
    std::optional<KernelSheets>& sheets = sheets_[static_cast<std::size_t>(axis)];
    if (!sheets) sheets = find_sheets(frame.cloud, axis);
    return *sheets;
  }

  void upload(const VolumeTargets& targets, const Texture& texture,
              const std::vector<glm::vec4>& rows) const {
    gl_.TextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(targets.width),
                          static_cast<GLsizei>(targets.height), GL_RGBA, GL_FLOAT, rows.data());
  }

  const Gl& gl_;
  std::array<std::optional<KernelSheets>, 3> sheets_;  ///< by axis
  std::uint64_t version_ = 0;
};

}  // namespace

bool is_for_cpu(const Gl& gl, const KernelCloud& cloud, const VolumeSettings& settings) {
  if (visibility_of(cloud, settings.visibility) == VolumeVisibility::ImageSheet) return false;
  return settings.drawn_by == VolumeDrawingBy::Cpu ||
         (settings.drawn_by == VolumeDrawingBy::Automatic && draws_on_cpu(gl));
}

std::unique_ptr<CpuDrawing> make_cpu_drawing(const Gl& gl) {
  return std::make_unique<TiledDrawing>(gl);
}

}  // namespace relief::volume

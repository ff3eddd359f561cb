#include "renderer/store/seam_store.h"

#include <glm/matrix.hpp>
#include <utility>

#include "common/seams/cell_triangles.h"
#include "common/seams/flat_map.h"
#include "common/seams/make_seams.h"
#include "renderer/store/patch_attributes.h"

namespace relief {
namespace {

/// A world position in the grid frame of a patch.
glm::vec3 in_grid(const Patch& patch, glm::dvec3 position) {
  return {glm::transpose(patch.axes) * (position - patch.origin) / patch.spacing};
}

/// The vertices of a patch's triangles, each once.
class PatchVertices {
 public:
  PatchVertices(std::span<const Patch> patches, std::uint32_t patch, const Seams& seams,
                std::vector<shared::SeamVertex>& vertices)
      : patches_(patches),
        patch_(patch),
        height_step_(static_cast<float>(patches[patch].height_step / patches[patch].spacing)),
        seams_(seams),
        vertices_(vertices) {}

  std::uint32_t number_of(std::uint32_t corner) {
    const auto next = static_cast<std::uint32_t>(vertices_.size());
    const std::uint32_t number = numbers_.insert(corner, next);
    if (number == next) vertices_.push_back(make(corner));
    return number;
  }

 private:
  [[nodiscard]] shared::SeamVertex make(std::uint32_t corner) const {
    const Patch& patch = patches_[patch_];
    if ((corner & kSeamVertexBit) == 0) {
      // As the vertex stage of cells computes it, so that the two meet.
      const glm::vec3 node(corner % patch.width, corner / patch.width,
                           static_cast<float>(patch.heights[corner]) * height_step_);
      return {glm::vec4(node, 0.0F), glm::vec4(node, 0.0F)};
    }
    const SeamVertex& vertex = seams_.vertices[corner & ~kSeamVertexBit];
    const auto owner = static_cast<float>(static_cast<std::int64_t>(vertex.patch) - patch_);
    return {glm::vec4(in_grid(patch, vertex.position), owner),
            glm::vec4(in_grid(patches_[vertex.patch], vertex.position), 0.0F)};
  }

  std::span<const Patch> patches_;
  std::uint32_t patch_;
  float height_step_;
  const Seams& seams_;
  std::vector<shared::SeamVertex>& vertices_;
  FlatMap numbers_;
};

/// Calls `visit` with the nodes of each triangle of the whole cells that touch one that is not.
template <class Visit>
void for_each_ring_triangle(const Patch& patch, const Visit& visit) {
  const CellTriangles cells = cell_triangles(patch);
  const auto is_inside = [&cells](std::uint32_t i, std::uint32_t j) {
    return is_surrounded(cells, i, j) && is_surrounded(cells, i + 1, j) &&
           is_surrounded(cells, i, j + 1) && is_surrounded(cells, i + 1, j + 1);
  };
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      if (cells.at(i, j) == kWholeCell && !is_inside(i, j))
        for_each_triangle(patch, cells, i, j, visit);
    }
  }
}

}  // namespace

SeamUpload::SeamUpload(const Gl& gl, const PatchModel& model, bool needed, bool with_rings)
    : gl_(gl), model_(model), with_rings_(with_rings) {
  if (!needed) return;
  for (const PatchRun& run : model.joined) {
    Seams& seams = made_[run.first];
    making_.run([&seams, run, patches = std::span(model.patches).subspan(run.first, run.count)] {
      seams = make_seams(patches, run.is_closed);
    });
  }
}

Result<std::span<const SeamCorners>> SeamUpload::get(PatchRun run) {
  const auto [found, is_new] = runs_.try_emplace(run.first);
  std::vector<SeamCorners>& shares = found->second;
  if (!is_new) return std::span<const SeamCorners>(shares);
  const auto patches = std::span(model_.patches).subspan(run.first, run.count);
  making_.wait();
  const auto made = made_.extract(run.first);
  const Seams& seams = made.mapped();
  for (std::uint32_t p = 0; p < run.count; ++p) {
    PatchVertices vertices(patches, p, seams, vertices_);
    const auto first = static_cast<std::uint32_t>(corners_.size());
    for (const Triangle& t : seams.triangles[p]) {
      for (const std::uint32_t corner : t) corners_.push_back(vertices.number_of(corner));
    }
    const auto ring = static_cast<std::uint32_t>(corners_.size());
    if (with_rings_) {
      for_each_ring_triangle(patches[p], [&](const std::array<std::uint32_t, 3>& nodes) {
        for (const std::uint32_t node : nodes) corners_.push_back(vertices.number_of(node));
      });
    }
    shares.push_back({first, ring - first, static_cast<std::uint32_t>(corners_.size()) - ring});
  }
  const auto most = static_cast<std::size_t>(get_limit(gl_, GL_MAX_TEXTURE_BUFFER_SIZE));
  if (2 * vertices_.size() > most) {
    return make_error(
        "the seams between patches have {} vertices, more than this OpenGL can draw ({}); "
        "convert again with a larger spacing",
        vertices_.size(), most / 2);
  }
  return std::span<const SeamCorners>(shares);
}

SeamStore SeamUpload::take(std::vector<StoredSeam> seams, const Buffer& positions) {
  Buffer corners = make_buffer(gl_, "seam corners", std::span<const std::uint32_t>(corners_));
  VertexArray attributes =
      make_patch_attributes(gl_, "seams", positions, sizeof(glm::uvec2), corners);
  return {
      std::move(seams),
      make_table(gl_, "seam vertices", GL_RGBA32F, std::span<const shared::SeamVertex>(vertices_)),
      std::move(corners), std::move(attributes)};
}

}  // namespace relief

#include "renderer/store/seam_store.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

#include "common/flat_map.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/make_seams.h"
#include "renderer/store/patch_attributes.h"

namespace relief {
namespace {

/// Cells of a block of seams, each way: the Dragon's frame takes 63.5 ms, in blocks of 28 64.8, of
/// 10 65.3.
constexpr std::uint32_t kSeamBlockCells = 14;

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

/// The triangles of a patch's share, in squares of the patch.
class ShareBlocks {
 public:
  ShareBlocks(const Patch& patch, std::uint32_t patch_number, const Seams& seams)
      : width_(patch.width),
        columns_((patch.width + kSeamBlockCells - 1) / kSeamBlockCells),
        blocks_(std::size_t{columns_} * ((patch.height + kSeamBlockCells - 1) / kSeamBlockCells)) {
    for (const Triangle& t : seams.triangles[patch_number]) {
      const std::uint32_t node = *std::min_element(t.begin(), t.end());
      if ((node & kSeamVertexBit) == 0) {
        at(node % width_, node / width_).seams.push_back(t);
        continue;
      }
      const glm::vec3 p = in_grid(patch, seams.vertices[node & ~kSeamVertexBit].position);
      const auto within = [](float x, std::uint32_t nodes) {
        return static_cast<std::uint32_t>(std::clamp(x, 0.0F, static_cast<float>(nodes - 1)));
      };
      at(within(p.x, patch.width), within(p.y, patch.height)).seams.push_back(t);
    }
  }

  void add_ring(const Patch& patch) {
    for_each_ring_triangle(patch, [&](const std::array<std::uint32_t, 3>& nodes) {
      at(nodes[0] % width_, nodes[0] / width_).ring.push_back(nodes);
    });
  }

  struct Block {
    std::vector<Triangle> seams;
    std::vector<Triangle> ring;
  };
  [[nodiscard]] const std::vector<Block>& all() const { return blocks_; }

 private:
  Block& at(std::uint32_t i, std::uint32_t j) {
    return blocks_[std::size_t{j / kSeamBlockCells} * columns_ + i / kSeamBlockCells];
  }

  std::uint32_t width_;
  std::uint32_t columns_;
  std::vector<Block> blocks_;
};

/// Notes which way triangles face, and the sphere about them.
void add_bounds(std::span<const std::uint32_t> corners,
                std::span<const shared::SeamVertex> vertices, SeamBlock& block) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    std::array<glm::vec3, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = glm::vec3(vertices[corners[k + c]].own);
      low = glm::min(low, p[c]);
      high = glm::max(high, p[c]);
    }
    const glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(normal);
    if (length > 0.0F) block.normals.add(normal / length);
  }
  block.centre = 0.5F * (low + high);
  block.radius = 0.5F * glm::length(high - low);
}

}  // namespace

SeamUpload::SeamUpload(const StoreLimits& limits, const PatchModel& model, bool needed,
                       bool with_rings)
    : most_texels_(limits.most_buffer_texels), model_(model), with_rings_(with_rings) {
  if (!needed) return;
  for (const PatchRun& run : model.joined) {
    Seams& seams = made_[run.first];
    making_.run([&seams, run, patches = std::span(model.patches).subspan(run.first, run.count)] {
      seams = make_seams(patches, run.is_closed);
    });
  }
}

const Seams& SeamUpload::made(PatchRun run) {
  making_.wait();
  return made_.at(run.first);
}

Result<std::span<const SeamBlocks>> SeamUpload::get(PatchRun run) {
  const auto [found, is_new] = runs_.try_emplace(run.first);
  std::vector<SeamBlocks>& shares = found->second;
  if (!is_new) return std::span<const SeamBlocks>(shares);
  const auto patches = std::span(model_.patches).subspan(run.first, run.count);
  making_.wait();
  const auto made = made_.extract(run.first);
  const Seams& seams = made.mapped();
  for (std::uint32_t p = 0; p < run.count; ++p) {
    PatchVertices vertices(patches, p, seams, vertices_);
    ShareBlocks share(patches[p], p, seams);
    if (with_rings_) share.add_ring(patches[p]);
    SeamBlocks& blocks = shares.emplace_back();
    const auto add = [&](const std::vector<Triangle>& some) {
      for (const Triangle& t : some) {
        for (const std::uint32_t corner : t) corners_.push_back(vertices.number_of(corner));
      }
      return static_cast<std::uint32_t>(3 * some.size());
    };
    for (const ShareBlocks::Block& triangles : share.all()) {
      if (triangles.seams.empty() && triangles.ring.empty()) continue;
      SeamBlock block;
      block.first = static_cast<std::uint32_t>(corners_.size());
      block.count = add(triangles.seams);
      block.ring = add(triangles.ring);
      add_bounds(std::span(corners_).subspan(block.first), vertices_, block);
      blocks.push_back(block);
    }
  }
  if (2 * vertices_.size() > most_texels_) {
    return make_error(
        "the seams between patches have {} vertices, more than this OpenGL can draw ({}); "
        "convert again with a larger spacing",
        vertices_.size(), most_texels_ / 2);
  }
  return std::span<const SeamBlocks>(shares);
}

SeamStore SeamUpload::take(const Gl& gl, std::vector<StoredSeam> seams, const Buffer& positions) {
  Buffer corners = make_buffer(gl, "seam corners", std::span<const std::uint32_t>(corners_));
  VertexArray attributes =
      make_patch_attributes(gl, "seams", positions, sizeof(glm::uvec2), corners);
  return {
      std::move(seams),
      make_table(gl, "seam vertices", GL_RGBA32F, std::span<const shared::SeamVertex>(vertices_)),
      std::move(corners), std::move(attributes)};
}

}  // namespace relief

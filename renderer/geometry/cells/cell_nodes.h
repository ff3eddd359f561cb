// The samples of a patch with their splats, and which cells they make.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "common/patch.h"
#include "renderer/geometry/samples/padded_heights.h"
#include "renderer/geometry/samples/samples.h"

namespace relief {

/// Looks samples up by node, or by the padded index of one. `samples` are those of `patch` and
/// outlive this.
class CellNodes {
 public:
  CellNodes(const Patch& patch, const PatchSamples& samples);

  [[nodiscard]] static glm::uvec2 node_of(const SampleRecord& record);

  [[nodiscard]] std::size_t index(glm::uvec2 node) const { return heights_.index(node.x, node.y); }

  /// Whether a node is the lower left of a cell with four samples.
  [[nodiscard]] bool has_four(glm::uvec2 node) const;

  /// The same if they lie on one sheet.
  [[nodiscard]] bool is_cell(glm::uvec2 node) const;

  /// Whether one of the cells at a node has four samples but jumps to another sheet; of those that
  /// `counts` accepts.
  template <class Counts>
  [[nodiscard]] bool beside_jump(glm::uvec2 node, const Counts& counts) const {
    for (const glm::uvec2 back : {glm::uvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      if (node.x < back.x || node.y < back.y) continue;
      const glm::uvec2 corner = node - back;
      if (has_four(corner) && !is_cell(corner) && counts(corner)) return true;
    }
    return false;
  }

  [[nodiscard]] bool is_border(std::size_t k) const;

  /// One over the cosine of a splat's tilt.
  [[nodiscard]] float steepness(std::size_t k) const;

  /// The reaches of a splat with the margins that close its gaps, packed; those toward holes are 0
  /// unless they are asked for.
  [[nodiscard]] std::uint32_t closed_reach(const SampleRecord& record, bool toward_holes) const;

  /// How far a splat's plane is off the edges of the cells beside it where it ends (cells, along
  /// its normal).
  [[nodiscard]] float off_edges(const SampleRecord& record) const;

 private:
  /// Whether the rise from a node to one beside it is one that a splat may have.
  [[nodiscard]] bool on_one_sheet(std::size_t k, std::size_t beside) const;
  [[nodiscard]] glm::vec2 slope_of(const SampleRecord& record) const;

  PaddedHeights heights_;
  const PatchSamples& samples_;
  std::vector<const SampleRecord*> records_;  ///< null: a hole
};

}  // namespace relief

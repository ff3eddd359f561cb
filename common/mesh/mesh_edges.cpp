#include "common/mesh/mesh_edges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace relief {
namespace {

/// Statistics of the edges of some points.
struct Census {
  bool all_have_two = true;
  bool has_border = false;
  std::uint64_t inner = 0;
  std::uint64_t alike = 0;
};

/// Adds the edges of one point, with adjacent uses of each.
void count(std::span<const EdgeUse> uses, Census& census) {
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t end = first + 1;
    std::uint64_t alike = 0;
    for (; end < uses.size() && uses[end].greater == uses[first].greater; ++end) {
      if (uses[end].forward == uses[first].forward) ++alike;
    }
    census.all_have_two = census.all_have_two && end - first == 2 && alike == 0;
    census.has_border = census.has_border || end - first == 1;
    census.inner += end - first - 1;
    census.alike += alike;
    first = end;
  }
}

}  // namespace

MeshEdges::MeshEdges(std::size_t points, std::span<const Triangle> triangles) {
  if (triangles.empty()) return;  // a large scan needs no table
  starts_.assign(points + 1, 0);
  const auto for_each_edge = [triangles](const auto& fn) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const Triangle& corners = triangles[t];
      for (std::size_t c = 0; c < 3; ++c) fn(t, corners[c], corners[(c + 1) % 3]);
    }
  };
  for_each_edge([this](std::uint32_t /*t*/, std::uint32_t from, std::uint32_t to) {
    ++starts_[std::min(from, to) + 1];
  });
  for (std::size_t p = 1; p < starts_.size(); ++p) starts_[p] += starts_[p - 1];
  std::vector<std::uint64_t> cursor(starts_.begin(), starts_.end() - 1);
  uses_.resize(3 * triangles.size());
  for_each_edge([&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    uses_[cursor[std::min(from, to)]++] = {std::max(from, to), t, from < to};
  });

  const Census census = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, points, 4096), Census{},
      [&](const tbb::blocked_range<std::size_t>& range, Census part) {
        for (std::size_t p = range.begin(); p != range.end(); ++p) {
          const std::span<EdgeUse> uses =
              std::span(uses_).subspan(starts_[p], starts_[p + 1] - starts_[p]);
          std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
            return a.greater != b.greater ? a.greater < b.greater : a.triangle < b.triangle;
          });
          count(uses, part);
        }
        return part;
      },
      [](const Census& a, const Census& b) {
        return Census{a.all_have_two && b.all_have_two, a.has_border || b.has_border,
                      a.inner + b.inner, a.alike + b.alike};
      });
  all_have_two_ = census.all_have_two;
  has_border_ = census.has_border;
  misoriented_ = census.inner > 0
                     ? static_cast<double>(census.alike) / static_cast<double>(census.inner)
                     : 1.0;
}

}  // namespace relief

#include "common/neighbours/position_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

namespace relief {
namespace {

struct Entry {
  glm::dvec3 position;
  std::uint32_t index;
};

struct Box {
  glm::dvec3 low;
  glm::dvec3 high;
};

struct Cut {
  glm::length_t axis = 0;
  double value = 0.0;
};

/// Returns the box of the entries; there is at least one.
Box box_of(std::span<const Entry> entries) {
  Box box{entries[0].position, entries[0].position};
  for (const Entry& entry : entries) {
    box.low = glm::min(box.low, entry.position);
    box.high = glm::max(box.high, entry.position);
  }
  return box;
}

/// The middle of the longest side of `box`, moved to the nearest entry if all entries lie on one
/// side of it. Of sides of the same length but for rounding, the one along which the entries spread
/// farthest; of these, the first.
Cut choose_cut(std::span<const Entry> entries, const Box& box) {
  constexpr double kAsLong = 1.0 - 0.00001;
  const glm::dvec3 sides = box.high - box.low;
  const double longest = std::max({sides.x, sides.y, sides.z});
  Cut cut;
  double farthest = -1.0;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    // Without a longest side all entries are in one position, and any cut will do.
    if (sides[axis] <= kAsLong * longest && longest > 0.0) continue;
    double low = entries[0].position[axis];
    double high = low;
    for (const Entry& entry : entries) {
      low = std::min(low, entry.position[axis]);
      high = std::max(high, entry.position[axis]);
    }
    if (high - low <= farthest) continue;
    farthest = high - low;
    cut = {axis, std::clamp((box.low[axis] + box.high[axis]) / 2.0, low, high)};
  }
  return cut;
}

/// Moves the entries that `first` is true for to the front and returns how many there are. Unlike
/// std::partition it leaves the same order with every standard library.
template <class Predicate>
std::size_t move_to_front(std::span<Entry> entries, const Predicate& first) {
  std::size_t begin = 0;
  std::size_t end = entries.size();
  for (;;) {
    while (begin < end && first(entries[begin])) ++begin;
    while (begin < end && !first(entries[end - 1])) --end;
    if (begin == end) return begin;
    std::swap(entries[begin++], entries[--end]);
  }
}

/// Sorts the entries into those below the cut, on it and above it. Returns how many go to the lower
/// side: those on the cut go where they make the sides more equal.
std::size_t split_at(std::span<Entry> entries, Cut cut) {
  const auto below = [cut](const Entry& e) { return e.position[cut.axis] < cut.value; };
  const auto not_above = [cut](const Entry& e) { return e.position[cut.axis] <= cut.value; };
  const std::size_t first_on = move_to_front(entries, below);
  const std::size_t first_above = first_on + move_to_front(entries.subspan(first_on), not_above);
  return std::clamp(entries.size() / 2, first_on, first_above);
}

// Sides of splits of more entries are built in parallel: fewer take less than a millisecond.
constexpr std::uint32_t kManyEntries = 8192;

struct TreeBuilder {
  using Node = PositionTree::Node;
  std::vector<Node>& nodes;
  std::span<Entry> all;

  /// Adds the nodes of the slots [first, first + count), which lie in `box`. Returns the box of
  /// their positions.
  Box add(std::uint32_t first, std::uint32_t count, const Box& box) {
    const std::span<Entry> entries = all.subspan(first, count);
    const std::size_t at = nodes.size();
    nodes.emplace_back();
    if (count <= PositionTree::kLeafSize) {
      nodes[at].first = first;
      nodes[at].count = count;
      return box_of(entries);
    }
    const Cut cut = choose_cut(entries, box);
    const auto lower_count = static_cast<std::uint32_t>(split_at(entries, cut));
    Box lower = box;
    lower.high[cut.axis] = cut.value;
    Box upper = box;
    upper.low[cut.axis] = cut.value;
    nodes[at].axis = static_cast<std::uint32_t>(cut.axis);
    if (count < kManyEntries) {
      lower = add(first, lower_count, lower);
      nodes[at].first = static_cast<std::uint32_t>(nodes.size());
      upper = add(first + lower_count, count - lower_count, upper);
    } else {
      std::vector<Node> lower_nodes;
      std::vector<Node> upper_nodes;
      tbb::parallel_invoke(
          [&] {
            lower = TreeBuilder{lower_nodes, all}.add(first, lower_count, lower);
          },
          [&] {
            upper =
                TreeBuilder{upper_nodes, all}.add(first + lower_count, count - lower_count, upper);
          });
      append(lower_nodes);
      nodes[at].first = static_cast<std::uint32_t>(nodes.size());
      append(upper_nodes);
    }
    nodes[at].low = lower.high[cut.axis];
    nodes[at].high = upper.low[cut.axis];
    return {glm::min(lower.low, upper.low), glm::max(lower.high, upper.high)};
  }

  /// Adds the nodes of a tree of their own.
  void append(const std::vector<Node>& tree) {
    const auto before = static_cast<std::uint32_t>(nodes.size());
    for (Node node : tree) {
      if (node.axis != Node::kLeaf) node.first += before;
      nodes.push_back(node);
    }
  }
};

}  // namespace

PositionTree::PositionTree(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return;
  std::vector<Entry> entries(positions.size());
  for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {positions[i], i};
  const Box box = box_of(entries);
  lowest_ = box.low;
  highest_ = box.high;
  TreeBuilder{nodes_, entries}.add(0, static_cast<std::uint32_t>(entries.size()), box);

  order_.resize(entries.size());
  for (std::vector<double>* axis : {&x_, &y_, &z_}) axis->resize(entries.size() + kLeafSize);
  for (std::size_t slot = 0; slot < entries.size(); ++slot) {
    order_[slot] = entries[slot].index;
    x_[slot] = entries[slot].position.x;
    y_[slot] = entries[slot].position.y;
    z_[slot] = entries[slot].position.z;
  }
}

}  // namespace relief

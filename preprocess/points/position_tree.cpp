#include "preprocess/points/position_tree.h"

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

/// The box of the entries, of which there is at least one.
Box box_of(std::span<const Entry> entries) {
  Box box{entries[0].position, entries[0].position};
  for (const Entry& entry : entries) {
    box.low = glm::min(box.low, entry.position);
    box.high = glm::max(box.high, entry.position);
  }
  return box;
}

/// The middle of the longest side of `box`. Of sides that are equally long but for rounding, the
/// one along which the entries spread most; of these, the first axis. Moved to the nearest entry if
/// all lie on one side of it.
Cut choose_cut(std::span<const Entry> entries, const Box& box) {
  constexpr double kAsLong = 1.0 - 0.00001;
  const glm::dvec3 sides = box.high - box.low;
  const double longest = std::max({sides.x, sides.y, sides.z});
  const Box tight = box_of(entries);
  Cut cut;
  double most = -1.0;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const double spread = tight.high[axis] - tight.low[axis];
    if (sides[axis] > kAsLong * longest && spread > most) {
      cut.axis = axis;
      most = spread;
    }
  }
  const glm::length_t axis = cut.axis;
  cut.value = std::clamp((box.low[axis] + box.high[axis]) / 2.0, tight.low[axis], tight.high[axis]);
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

}  // namespace

struct PositionTree::Builder {
  std::vector<Node>& nodes;
  std::span<Entry> all;

  /// Adds the nodes of the slots [first, first + count), which lie in `box`. Returns the box of
  /// their positions.
  Box add(std::uint32_t first, std::uint32_t count, const Box& box) {
    const std::span<Entry> entries = all.subspan(first, count);
    const std::size_t at = nodes.size();
    nodes.emplace_back();
    if (count <= kLeafSize) {
      nodes[at].first = first;
      nodes[at].count = count;
      return box_of(entries);
    }
    const Cut cut = choose_cut(entries, box);
    const auto lower_count = static_cast<std::uint32_t>(split_at(entries, cut));
    Box lower = box;
    lower.high[cut.axis] = cut.value;
    lower = add(first, lower_count, lower);
    nodes[at].axis = static_cast<std::uint32_t>(cut.axis);
    nodes[at].first = static_cast<std::uint32_t>(nodes.size());
    Box upper = box;
    upper.low[cut.axis] = cut.value;
    upper = add(first + lower_count, count - lower_count, upper);
    nodes[at].low = lower.high[cut.axis];
    nodes[at].high = upper.low[cut.axis];
    return {glm::min(lower.low, upper.low), glm::max(lower.high, upper.high)};
  }
};

PositionTree::PositionTree(const std::vector<glm::dvec3>& positions) {
  if (positions.empty()) return;
  std::vector<Entry> entries(positions.size());
  for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {positions[i], i};
  const Box box = box_of(entries);
  lowest_ = box.low;
  highest_ = box.high;
  Builder{nodes_, entries}.add(0, static_cast<std::uint32_t>(entries.size()), box);

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

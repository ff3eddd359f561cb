#include "renderer/store/spans.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace relief {

std::optional<std::uint32_t> Spans::take(std::uint32_t count) {
  if (count == 0) return 0;
  for (auto gap = gaps_.begin(); gap != gaps_.end(); ++gap) {
    const auto [first, places] = *gap;
    if (places < count) continue;
    gaps_.erase(gap);
    if (places > count) gaps_.emplace(first + count, places - count);
    taken_ += count;
    return first;
  }
  return std::nullopt;
}

bool Spans::has(std::uint32_t count) const {
  return count == 0 || std::any_of(gaps_.begin(), gaps_.end(),
                                   [count](const auto& gap) { return gap.second >= count; });
}

void Spans::give(std::uint32_t first, std::uint32_t count) {
  if (count == 0) return;
  assert(count <= taken_ && first + count <= size_ && "what was taken");
  taken_ -= count;
  auto next = gaps_.lower_bound(first);
  if (next != gaps_.end() && next->first == first + count) {
    count += next->second;
    next = gaps_.erase(next);
  }
  if (next != gaps_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == first) {
      before->second += count;
      return;
    }
  }
  gaps_.emplace(first, count);
}

void Spans::grow(std::uint32_t size) {
  assert(size >= size_ && "it never shrinks");
  const std::uint32_t more = size - size_;
  size_ = size;
  taken_ += more;
  give(size - more, more);
}

}  // namespace relief

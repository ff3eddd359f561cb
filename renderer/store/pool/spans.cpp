#include "renderer/store/pool/spans.h"

#include <cassert>
#include <iterator>

namespace relief {

std::optional<std::uint32_t> Spans::take(std::uint32_t count) {
  if (count == 0) return 0;
  for (const auto& [first, places] : gaps_) {
    if (places < count) continue;
    const std::uint32_t taken = first;
    take(taken, count);
    return taken;
  }
  return std::nullopt;
}

bool Spans::has(std::uint32_t first, std::uint32_t count) const {
  auto gap = gaps_.upper_bound(first);
  if (gap == gaps_.begin()) return false;
  --gap;
  return first + count <= gap->first + gap->second;
}

void Spans::take(std::uint32_t first, std::uint32_t count) {
  assert(count > 0 && has(first, count) && "free places");
  const auto gap = std::prev(gaps_.upper_bound(first));
  const std::uint32_t end = gap->first + gap->second;
  gap->second = first - gap->first;
  if (gap->second == 0) gaps_.erase(gap);
  if (end > first + count) gaps_.emplace(first + count, end - first - count);
  taken_ += count;
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

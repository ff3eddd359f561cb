#include "renderer/engines/ewa/layered_buffer.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace relief::ewa {

glm::dvec4 blend_over(glm::dvec4 front, glm::dvec4 back) {
  return front + (1.0 - front.a) * back;
}

LayeredBuffer::LayeredBuffer(std::size_t pixels, int layers, double coverage_threshold,
                             ShadeSurface shade)
    : slots_(static_cast<std::size_t>(layers) + 1),
      coverage_threshold_(coverage_threshold),
      shade_(std::move(shade)),
      fragments_(pixels * slots_),
      counts_(pixels, 0) {
  assert(layers >= 1 && coverage_threshold > 0.0 && "settings that were checked");
}

void LayeredBuffer::add(std::size_t pixel, const Contribution& contribution,
                        const SplatAttributes& attributes) {
  Fragment* const fragments = fragments_.data() + pixel * slots_;
  const std::size_t count = counts_[pixel];
  Fragment* same = nullptr;
  double least = contribution.threshold;
  bool hidden = false;
  for (std::size_t i = 0; i < count; ++i) {
    const double behind = contribution.depth - fragments[i].depth();
    if (!fragments[i].shaded && std::abs(behind) < least) {
      least = std::abs(behind);
      same = fragments + i;
    }
    const bool covers = single() || fragments[i].hides(coverage_threshold_);
    hidden = hidden || (behind > 0.0 && covers);
  }
  if (same != nullptr) return same->add(contribution, attributes);
  if (hidden) return;
  Fragment fragment;
  fragment.add(contribution, attributes);
  start_fragment(pixel, fragment);
}

void LayeredBuffer::start_fragment(std::size_t pixel, const Fragment& fragment) {
  std::size_t& count = counts_[pixel];
  if (single()) count = 0;  // one layer: it is before the one that was there
  fragments_[pixel * slots_ + count++] = fragment;
  if (count < slots_) return;
  make_room(pixel);
  if (count == slots_) merge_closest(pixel);
}

/// Drops what an opaque fragment hides.
void LayeredBuffer::make_room(std::size_t pixel) {
  Fragment* const fragments = fragments_.data() + pixel * slots_;
  std::size_t& count = counts_[pixel];
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    if (fragments[i].hides(coverage_threshold_)) limit = std::min(limit, fragments[i].depth());
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (fragments[i].depth() <= limit) fragments[kept++] = fragments[i];
  }
  count = kept;
}

/// Of two fragments, the front one keeps its attributes unless it covers less than half.
void LayeredBuffer::merge_closest(std::size_t pixel) {
  Fragment* const fragments = fragments_.data() + pixel * slots_;
  std::size_t& count = counts_[pixel];
  std::pair<std::size_t, std::size_t> closest{0, 1};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const double distance = std::abs(fragments[i].depth() - fragments[j].depth());
      if (distance >= least) continue;
      least = distance;
      closest = {i, j};
    }
  }
  auto [front, back] = closest;
  if (fragments[back].depth() < fragments[front].depth()) std::swap(front, back);
  shade_once(pixel, fragments[front]);
  shade_once(pixel, fragments[back]);
  const bool front_is_seen = fragments[front].coverage(coverage_threshold_) >= 0.5 ||
                             fragments[front].weight >= fragments[back].weight;
  Fragment merged = fragments[front_is_seen ? front : back];
  merged.colour = blend_over(fragments[front].colour, fragments[back].colour);
  fragments[closest.first] = merged;
  fragments[closest.second] = fragments[count - 1];
  --count;
}

void LayeredBuffer::shade_once(std::size_t pixel, Fragment& fragment) const {
  if (fragment.shaded) return;
  const glm::dvec4 colour = fragment.colour / fragment.weight;
  const double length = glm::length(fragment.normal_sum);
  const glm::dvec3 normal = length > 0.0 ? fragment.normal_sum / length : glm::dvec3(0.0);
  const glm::dvec3 seen = shade_({pixel, glm::dvec3(colour), normal, fragment.material});
  const double alpha = colour.a * fragment.coverage(coverage_threshold_);
  fragment.colour = glm::dvec4(alpha * seen, alpha);
  fragment.shaded = true;
}

ResolvedPixel LayeredBuffer::resolve(std::size_t pixel) {
  Fragment* const fragments = fragments_.data() + pixel * slots_;
  make_room(pixel);
  const std::size_t count = counts_[pixel];
  std::sort(fragments, fragments + count,
            [](const Fragment& a, const Fragment& b) { return a.depth() < b.depth(); });
  ResolvedPixel resolved;
  double covered = 0.0;
  for (std::size_t i = count; i-- > 0;) {
    shade_once(pixel, fragments[i]);
    resolved.colour = blend_over(fragments[i].colour, resolved.colour);
    covered += fragments[i].coverage(coverage_threshold_);
  }
  const double half = 0.5 * std::min(covered, 1.0);
  double reached = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    reached += fragments[i].coverage(coverage_threshold_);
    if (reached < half) continue;
    const Fragment& seen = fragments[i];
    resolved.depth = seen.depth();
    const double length = glm::length(seen.normal_sum);
    if (length > 0.0) resolved.normal = seen.normal_sum / length;
    resolved.uv = seen.uv_sum / seen.uv_weight;
    resolved.patch = seen.patch;
    break;
  }
  return resolved;
}

}  // namespace relief::ewa

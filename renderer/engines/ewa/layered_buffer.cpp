#include "renderer/engines/ewa/layered_buffer.h"

#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

namespace relief::ewa {
namespace {

/// Neighbouring pixels whose normals differ by more than 30 degrees show different surfaces, or a
/// crease, over which there is nothing to interpolate.
constexpr double kLargestChange = 0.52;

/// The colour of shaded fragments, front first: of each those that meet it beside or behind it.
glm::dvec4 blend(std::span<const Fragment> fragments) {
  glm::dvec4 all(0.0);
  for (std::size_t i = 0; i < fragments.size();) {
    const Fragment& first = fragments[i];
    glm::dvec4 seen(0.0);
    glm::dvec4 behind(0.0);
    do {
      const Fragment& fragment = fragments[i++];
      glm::dvec4& side = fragment.faces_away == first.faces_away ? seen : behind;
      side = blend_beside(side, fragment.colour);
    } while (i < fragments.size() && fragments[i].meets(first));
    all = blend_over(all, blend_behind(seen, behind));
  }
  return all;
}

glm::dvec3 unit_or_zero(glm::dvec3 v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

}  // namespace

glm::dvec4 blend_over(glm::dvec4 front, glm::dvec4 back) {
  return front + (1.0 - front.a) * back;
}

glm::dvec4 blend_beside(glm::dvec4 one, glm::dvec4 other) {
  const double room = 1.0 - one.a;
  return one + (other.a > room ? room / other.a : 1.0) * other;
}

glm::dvec4 blend_behind(glm::dvec4 front, glm::dvec4 back) {
  return back.a > front.a ? front + (1.0 - front.a / back.a) * back : front;
}

LayeredBuffer::LayeredBuffer(std::size_t width, std::size_t rows, int layers,
                             double coverage_threshold, ShadeSurface shade)
    : width_(width),
      slots_(static_cast<std::size_t>(layers) + 1),
      coverage_threshold_(coverage_threshold),
      shade_(std::move(shade)),
      fragments_(width * rows * slots_),
      counts_(width * rows, 0) {
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
    const bool may_be_same = !fragments[i].shaded && !fragments[i].is_beyond_edge(attributes);
    if (may_be_same && std::abs(behind) < least) {
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
  merged.colour = blend(std::array{fragments[front], fragments[back]});
  fragments[closest.first] = merged;
  fragments[closest.second] = fragments[count - 1];
  --count;
}

void LayeredBuffer::shade_once(std::size_t pixel, Fragment& fragment) const {
  if (fragment.shaded) return;
  const glm::dvec4 colour = fragment.colour / fragment.weight;
  Surface surface{pixel, glm::dvec3(colour), unit_or_zero(fragment.normal_sum), fragment.depth(),
                  {},    fragment.material,  fragment.is_from_behind()};
  const std::size_t column = pixel % width_;
  if (column > 0) surface.changes[0] = normal_change(fragment, pixel - 1);
  if (column + 1 < width_) surface.changes[1] = normal_change(fragment, pixel + 1);
  if (pixel >= width_) surface.changes[2] = normal_change(fragment, pixel - width_);
  if (pixel + width_ < counts_.size()) surface.changes[3] = normal_change(fragment, pixel + width_);
  const glm::dvec3 seen = shade_(surface);
  const double alpha = colour.a * fragment.coverage(coverage_threshold_);
  fragment.colour = glm::dvec4(alpha * seen, alpha);
  fragment.shaded = true;
}

/// To the neighbour's fragment that is nearest in depth. Fragments keep their normals when they are
/// shaded.
glm::dvec3 LayeredBuffer::normal_change(const Fragment& fragment, std::size_t neighbour) const {
  const Fragment* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < counts_[neighbour]; ++i) {
    const Fragment& other = fragments_[neighbour * slots_ + i];
    const double distance = std::abs(other.depth() - fragment.depth());
    if (distance >= least) continue;
    least = distance;
    nearest = &other;
  }
  if (nearest == nullptr) return glm::dvec3(0.0);
  const glm::dvec3 change = unit_or_zero(nearest->normal_sum) - unit_or_zero(fragment.normal_sum);
  return glm::length(change) < kLargestChange ? change : glm::dvec3(0.0);
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
    covered += fragments[i].coverage(coverage_threshold_);
  }
  resolved.colour = blend({fragments, count});
  const double half = 0.5 * std::min(covered, 1.0);
  double reached = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    reached += fragments[i].coverage(coverage_threshold_);
    if (reached < half) continue;
    const Fragment& seen = fragments[i];
    resolved.depth = seen.depth();
    resolved.normal = unit_or_zero(seen.normal_sum);
    resolved.uv = seen.uv_sum / seen.uv_weight;
    resolved.patch = seen.patch;
    resolved.clip = seen.clip;
    break;
  }
  return resolved;
}

}  // namespace relief::ewa

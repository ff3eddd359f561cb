#include "preprocess/meeting.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

namespace relief {
namespace {

/// A scan is closed with up to so many of its points at borders: noise and thin parts look like
/// some (0 to 0.17 % of closed models of 5,000 to 130,000 points, with noise of a quarter of the
/// spacing; a ball with twelve small holes has 0.24 %, a vase 0.7 %).
constexpr double kClosed = 0.002;

}  // namespace

Meeting choose_meeting(const SurfaceSamples& samples, const NeighbourGraph& graph) {
  Meeting meeting;
  meeting.border =
      std::make_unique<ScanBorder>(samples, graph, std::numeric_limits<std::uint32_t>::max());
  CreaseNormals creases = find_creases(samples.positions, samples.normals, graph);
  const auto at_creases =
      static_cast<std::size_t>(std::ranges::count(creases.at_crease, std::uint8_t{1}));
  const auto count = static_cast<double>(samples.positions.size());
  const auto at_border = static_cast<double>(meeting.border->count());
  meeting.is_closed = at_border <= kClosed * count;
  if (!meeting.is_closed && at_border > static_cast<double>(at_creases)) return meeting;
  meeting.creases = std::move(creases);
  meeting.border.reset();
  return meeting;
}

}  // namespace relief

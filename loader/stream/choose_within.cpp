#include "loader/stream/choose_within.h"

#include <algorithm>
#include <map>
#include <queue>
#include <utility>

#include "loader/stream/cut.h"

namespace relief {

std::vector<std::uint32_t> choose_within(
    std::span<const TreeTile> tiles, std::span<const std::uint32_t> goal,
    const std::function<double(std::uint32_t)>& coarseness,
    const std::function<bool(std::span<const std::uint32_t>)>& add) {
  const TilePath path = path_to(tiles, goal);
  std::map<std::uint32_t, std::vector<std::uint32_t>> children;  // on the path
  for (const std::uint32_t t : path.tiles) children[tiles[t].parent].push_back(t);
  std::vector<std::uint32_t> chosen;
  std::priority_queue<std::pair<double, std::uint32_t>> coarse;
  const auto put = [&](std::span<const std::uint32_t> some) {
    for (const std::uint32_t t : some) {
      if (std::ranges::binary_search(goal, t))
        chosen.push_back(t);
      else
        coarse.emplace(coarseness(t), t);
    }
  };
  const std::vector<std::uint32_t>& first = children[kNoTile];
  static_cast<void>(add(first));
  put(first);
  while (!coarse.empty()) {
    const std::uint32_t t = coarse.top().second;
    coarse.pop();
    if (add(children[t]))
      put(children[t]);
    else
      chosen.push_back(t);
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace relief

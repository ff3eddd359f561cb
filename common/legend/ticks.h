// The numbers beside a colour bar.
#pragma once

#include <string>
#include <vector>

namespace relief {

struct Tick {
  double value = 0.0;
  std::string text;
};

/// Returns multiples of 1, 2 or 5 times a power of ten from `low` to `high`, at most `most` (2 or
/// more) and as many as possible. Their texts differ from each other and have as few digits as
/// that needs, also for a narrow range of large numbers. One tick if `low` is `high`, or if double
/// precision has no number between them.
[[nodiscard]] std::vector<Tick> find_ticks(double low, double high, int most);

}  // namespace relief

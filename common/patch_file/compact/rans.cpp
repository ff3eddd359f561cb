#include "common/patch_file/compact/rans.h"

#include <algorithm>

#include "common/io/bytes.h"

namespace relief {

void RansEncoder::finish(std::vector<std::byte>& out) const {
  // Coding runs backwards, so that decoding runs forwards.
  std::vector<std::uint16_t> words;
  words.reserve(intervals_.size() / 4);
  std::uint32_t state = kLeastState;
  for (auto interval = intervals_.rbegin(); interval != intervals_.rend(); ++interval) {
    // The decoder's state after this symbol is below 2^32 only if this one is below the limit.
    const std::uint64_t limit = std::uint64_t{interval->width} << (32U - kProbabilityBits);
    if (state >= limit) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16U;
    }
    state =
        (state / interval->width << kProbabilityBits) + state % interval->width + interval->start;
  }
  append_number(out, state);
  for (auto word = words.rbegin(); word != words.rend(); ++word) append_number(out, *word);
}

}  // namespace relief

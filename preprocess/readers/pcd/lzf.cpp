#include "preprocess/readers/pcd/lzf.h"

#include <algorithm>

namespace relief {

bool lzf_decompress(std::string_view packed, std::vector<char>& out) {
  std::size_t in = 0;
  std::size_t made = 0;
  const auto next = [&] {
    return static_cast<std::size_t>(static_cast<unsigned char>(packed[in++]));
  };
  while (in < packed.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - in || length > out.size() - made) return false;
      std::copy_n(packed.begin() + static_cast<std::ptrdiff_t>(in), length,
                  out.begin() + static_cast<std::ptrdiff_t>(made));
      in += length;
      made += length;
      continue;
    }
    std::size_t length = (control >> 5U) + 2;
    const std::size_t needed = length == 9 ? 2 : 1;
    if (needed > packed.size() - in) return false;
    if (length == 9) length += next();
    const std::size_t distance = ((control & 31U) << 8U) + next() + 1;
    if (distance > made || length > out.size() - made) return false;
    // Byte by byte: source and destination overlap when a run is repeated.
    for (std::size_t i = 0; i < length; ++i, ++made) out[made] = out[made - distance];
  }
  return made == out.size();
}

}  // namespace relief

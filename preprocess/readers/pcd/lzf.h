// LZF, the compression of binary_compressed PCD files (Marc Lehmann's liblzf, format 1).
#pragma once

#include <string_view>
#include <vector>

namespace relief {

/// One LZF byte cannot stand for more than this many: a back reference of 3 bytes gives 264.
inline constexpr std::size_t kLzfLargestRatio = 88;

/// Decompresses into exactly `out.size()` bytes; false if the data are damaged, that is, would give
/// fewer or more or refer to what lies before the start. Safe on any bytes.
[[nodiscard]] bool lzf_decompress(std::string_view packed, std::vector<char>& out);

}  // namespace relief

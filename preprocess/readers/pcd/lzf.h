// LZF, the compression of binary_compressed PCD files (Marc Lehmann's liblzf, format 1).
#pragma once

#include <string_view>
#include <vector>

namespace relief {

/// Upper bound of decompressed bytes per LZF byte: a back reference of 3 bytes gives 264.
inline constexpr std::size_t kLzfLargestRatio = 88;

/// Decompresses into exactly `out.size()` bytes. Returns false if the data are damaged: if they
/// give fewer or more bytes or refer to bytes before the start. Safe on any bytes.
[[nodiscard]] bool lzf_decompress(std::string_view packed, std::vector<char>& out);

}  // namespace relief

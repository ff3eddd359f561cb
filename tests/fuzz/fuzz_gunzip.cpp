// Fuzzes unpacking, with a limit that small inputs reach.
#include "preprocess/readers/gzip/gunzip.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::uint64_t kLimit = std::uint64_t{1} << 16U;
  const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
  if (!relief::is_gzip(bytes)) return 0;
  const relief::Progress progress;
  const auto unpacked = relief::gunzip("fuzzed", bytes, kLimit, progress);
  relief::fuzz::require(unpacked ? unpacked->size() <= kLimit
                                 : unpacked.error().message.starts_with("fuzzed: "));
  return 0;
}

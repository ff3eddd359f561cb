// Fuzzes the reader of OBJ's material files.
#include <string_view>

#include "preprocess/readers/obj/mtl.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read =
      relief::read_mtl("fuzzed", std::string_view(reinterpret_cast<const char*>(data), size));
  relief::fuzz::require(read || read.error().message.starts_with("fuzzed: "));
  return 0;
}

// Fuzzes the reader of scene files.
#include "common/scene/scene.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const relief::fuzz::MemoryFile file(data, size);
  if (const auto scene = relief::read_scene(file.path())) {
    relief::fuzz::require(!scene->models.empty() && !scene->views.empty());
  }
  return 0;
}

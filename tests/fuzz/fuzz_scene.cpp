// Fuzzes the reader of scene files.
#include "common/scene/scene.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const relief::fuzz::MemoryFile file(data, size);
  static const relief::EngineKeys kKeys{
      {"onepass", "raytrace"},
      {{.key = "primitive", .kind = relief::OptionKind::Choice, .choices = {"cell", "quad"}},
       {.key = "samples", .kind = relief::OptionKind::Integer, .range = {1.0, 64.0}}}};
  if (const auto scene = relief::read_scene(file.path(), kKeys)) {
    relief::fuzz::require(!scene->models.empty() && !scene->views.empty());
  }
  return 0;
}

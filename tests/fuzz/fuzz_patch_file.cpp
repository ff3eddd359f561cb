// Fuzzes the patch file of all versions: header, index, tiles, patches, their coarse levels and
// seams.
#include "common/patch_file/patch_file.h"
#include "common/patch_file/patch_tree.h"
#include "common/seams/join_normals.h"
#include "common/seams/make_seams.h"
#include "tests/fuzz/memory_file.h"

namespace relief::fuzz {
namespace {

void check(const Patch& patch) {
  require(patch.heights.size() == std::size_t{patch.width} * patch.height);
  require(patch.normals.texels.size() == std::size_t{patch.normals.width} * patch.normals.height);
  require(patch.colours.texels.size() == std::size_t{patch.colours.width} * patch.colours.height);
  for (const AttributeMap<std::uint16_t>& map : patch.scalars)
    require(map.texels.size() == std::size_t{map.width} * map.height);
}

void read(const PatchFile& file) {
  // The index gives a patch's size. Large patches are slow here and find nothing more.
  constexpr std::uint64_t kMaxNodes = 4096;
  constexpr std::size_t kMaxPatches = 4;
  PatchModel joined;
  for (std::size_t i = 0; i < std::min(file.patches().size(), kMaxPatches); ++i) {
    const PatchSummary& summary = file.patches()[i];
    if (std::uint64_t{summary.width} * summary.height > kMaxNodes) continue;
    if (const auto patch = file.read_patch(i)) {
      check(*patch);
      joined.patches.push_back(*patch);
    }
    for (unsigned level = 0; level <= file.info().levels; ++level) {
      if (const auto patch = file.read_level(i, level)) check(*patch);
    }
  }
  if (file.joined().empty()) return;
  joined.joined = {{0, static_cast<std::uint32_t>(joined.patches.size())}};
  join_normals(joined);
  const Seams seams = make_seams(joined.patches, file.joined().front().is_closed);
  require(seams.triangles.size() == joined.patches.size());
}

}  // namespace
}  // namespace relief::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  // NOLINT
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const relief::fuzz::MemoryFile bytes(data, size);
  const auto file = relief::PatchFile::open(bytes.path());
  if (file) relief::fuzz::read(*file);
  const auto tree = relief::PatchTree::open(bytes.path());
  constexpr std::uint32_t kMaxTiles = 4;
  for (std::uint32_t t = 0; tree && t < std::min<std::size_t>(tree->tiles().size(), kMaxTiles);
       ++t) {
    const auto tile = tree->open_tile(t);
    if (tile) relief::fuzz::read(*tile);
  }
  return 0;
}

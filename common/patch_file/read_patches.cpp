// Reads many patches at once.
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "common/guard.h"
#include "common/patch_file/fast/zstd_contexts.h"
#include "common/patch_file/patch_file.h"
#include "common/seams/join_normals.h"

namespace relief {

Status fits_memory(const std::string& name, std::uint64_t decoded_bytes) {
  const std::uint64_t there = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                              static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  if (decoded_bytes <= there) return {};
  return make_error(
      "{}: the patches take {} MB of memory, but this machine has {} MB; convert the scan again "
      "with a larger --spacing, or use a machine with more",
      name, decoded_bytes >> 20U, there >> 20U);
}

Result<std::vector<Patch>> PatchFile::read_patches(std::span<const std::uint64_t> patches,
                                                   Progress& progress,
                                                   const PatchSections& sections) const {
  const auto read_them = [&]() -> Result<std::vector<Patch>> {
    // Of several errors the first patch's is returned, whatever the threads do.
    std::vector<Patch> read(patches.size());
    tbb::enumerable_thread_specific<ZstdContexts> zstd;
    std::mutex mutex;
    std::size_t failed = patches.size();
    Error error;
    progress.begin_stage("reading patches", patches.size());
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t i) {
      if (progress.cancelled()) return;
      auto patch = read_patch(patches[i], zstd.local(), sections);
      if (patch) {
        read[i] = *std::move(patch);
      } else {
        const std::scoped_lock lock(mutex);
        if (i < failed) {
          failed = i;
          error = patch.error();
        }
      }
      progress.advance(1);
    });
    if (progress.cancelled()) return interrupted_error();
    if (failed < patches.size()) return error;
    return read;
  };
  return guarded({.subject = name(),
                  .task = "read its patches",
                  .advice = "the file may be damaged: convert the scan again",
                  .memory_advice = kMoreMemory},
                 read_them);
}

Result<PatchModel> PatchFile::read_all(Progress& progress, const PatchSections& sections) const {
  std::vector<std::uint64_t> all(patches().size());
  std::iota(all.begin(), all.end(), 0U);
  const std::uint64_t joining = joined().empty() ? 0 : kJoiningBytes * info().samples;
  RELIEF_TRY(fits_memory(name(), decoded_bytes(all, sections) + joining));
  RELIEF_TRY_ASSIGN(auto read, read_patches(all, progress, sections));
  PatchModel model;
  model.patches = std::move(read);
  model.spacing = info().spacing;
  model.bounds = info().bounds;
  model.bounding_radius = info().bounding_radius;
  model.extremes = info().extremes;
  model.stance = info().stance;
  model.is_closed = info().is_closed;
  model.is_of_points = info().is_of_points;
  model.joined = joined();
  if (sections.scalars) model.scalars = info().scalars;
  join_normals(model);
  model.has_colours = std::any_of(model.patches.begin(), model.patches.end(),
                                  [](const Patch& p) { return !p.colours.empty(); });
  return model;
}

}  // namespace relief

#include "preprocess/resample/region_patches.h"

#include <tbb/parallel_for.h>

#include <optional>
#include <utility>

#include "preprocess/measure/measure.h"
#include "preprocess/resample/borders/scan_border.h"
#include "preprocess/resample/borders/thin_borders.h"

namespace relief {
namespace {

// Patches of fewer points are tested for being covered by others.
constexpr std::size_t kSmallPatchPoints = 64;

std::vector<Patch> resample_all(const ScanSurface& scan, const std::vector<double>& factors,
                                const ResampleOptions& options, const std::vector<Region>& regions,
                                Progress& progress) {
  progress.begin_stage("resample", scan.samples.positions.size());
  std::vector<Patch> patches(regions.size());
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    if (progress.cancelled()) return;
    ResampleOptions own = options;
    own.spacing *= factors[r];
    patches[r] = resample_region(scan, regions[r], own);
    progress.advance(regions[r].points.size());
  });
  return patches;
}

// Drops small patches that others cover, and those without a sample.
void drop_redundant(const SurfaceSamples& samples, const NeighbourGraph& graph,
                    std::vector<Region>& regions, std::vector<Patch>& patches) {
  std::vector<std::vector<std::uint32_t>> own_points;
  own_points.reserve(regions.size());
  for (const Region& region : regions) own_points.push_back(region.points);
  const std::vector<std::uint8_t> redundant =
      find_redundant(samples.positions, graph, owners_of(regions, samples.positions.size()),
                     own_points, patches, kSmallPatchPoints);
  std::vector<Region> kept_regions;
  std::vector<Patch> kept_patches;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (redundant[r] != 0 || patches[r].heights.empty()) continue;
    kept_regions.push_back(std::move(regions[r]));
    kept_patches.push_back(std::move(patches[r]));
  }
  regions = std::move(kept_regions);
  patches = std::move(kept_patches);
}

}  // namespace

std::vector<std::uint32_t> owners_of(const std::vector<Region>& regions, std::size_t points) {
  std::vector<std::uint32_t> owner(points, static_cast<std::uint32_t>(regions.size()));
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (const std::uint32_t i : regions[r].points) owner[i] = r;
  }
  return owner;
}

std::vector<Patch> make_patches(const ScanSurface& scan, const std::vector<double>& factors,
                                const ResampleOptions& options, std::vector<Region>& regions,
                                Progress& progress) {
  ScanSurface bordered = scan;
  std::optional<ScanBorder> border;
  if (!options.seams && scan.border == nullptr) {
    border.emplace(scan.samples, scan.graph, scan.membership.of_others);
    bordered.border = &*border;
  }
  std::vector<Patch> patches = resample_all(bordered, factors, options, regions, progress);
  if (progress.cancelled()) return patches;
  drop_redundant(scan.samples, scan.graph, regions, patches);
  // Patches that are cut later have too many samples yet.
  if (options.seams && !scan.is_cut_later) thin_borders(patches);
  return patches;
}

}  // namespace relief

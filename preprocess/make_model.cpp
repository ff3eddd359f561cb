#include "preprocess/make_model.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <limits>

#include "common/seams/join_normals.h"
#include "common/seams/make_seams.h"
#include "preprocess/convert_stages.h"
#include "preprocess/mesh_fit/fit_to_mesh.h"
#include "preprocess/resample/borders/thin_borders.h"
#include "preprocess/resample/region_patches.h"
#include "preprocess/resample/spacing/error_spacing.h"
#include "preprocess/resample/spacing/patch_spacing.h"
#include "preprocess/texture/maps/node_normals.h"
#include "preprocess/texture/maps/texture_maps.h"

namespace relief {
namespace {

/// The area of all regions, estimated from their points' local spacings. Each region's is divided
/// by its factor squared, so that a cell of its grid counts as one of the model's spacing.
double area_of(const std::vector<Region>& regions, const std::vector<double>& factors,
               const SurfaceSamples& samples) {
  double area = 0.0;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    double own = 0.0;
    for (const std::uint32_t i : regions[r].points)
      own += double{samples.spacing[i]} * samples.spacing[i];
    area += own / (factors[r] * factors[r]);
  }
  return area;
}

/// How wide the faces are that regions are of; empty if nothing is known of faces.
std::vector<double> widths_of_faces(const PartitionedScan& scan) {
  std::vector<double> widths;
  if (scan.sides == nullptr) return widths;
  for (const Region& region : scan.regions) {
    const auto width = scan.sides->widths.find(side_of(*scan.sides, region.points));
    widths.push_back(width != scan.sides->widths.end() ? width->second
                                                       : std::numeric_limits<double>::infinity());
  }
  return widths;
}

/// How many samples there are, and each patch's share.
SampleBudget budget_of(const PartitionedScan& scan, const ConvertOptions& options,
                       std::optional<double> samples) {
  const bool seams = scan.creases != nullptr;
  const double fewest = samples.value_or(usual_samples(scan.measured, seams));
  SampleBudget budget{std::vector<double>(scan.regions.size(), 1.0), fewest};
  if (scan.follows_density) {
    budget.factors = spacing_factors(scan.samples, scan.regions);
  } else if (!options.adaptive_spacing && seams && scan.spheres != nullptr &&
             !(options.spacing > 0.0)) {
    const double most = samples.value_or(kMostSamplesPerPoint * static_cast<double>(scan.measured));
    budget = share_samples(scan.samples, scan.regions, scan.creases->at_crease, {fewest, most},
                           widths_of_faces(scan));
  }
  return budget;
}

/// Fits patches that meet to the mesh; others take its normals alone. `regions`: of the patches.
void take_mesh(const PartitionedScan& scan, const std::vector<Region>& regions,
               std::vector<Patch>& patches, Progress& progress) {
  const Points& mesh = scan.mesh;
  const TriangleSpheres& spheres = *scan.spheres;
  progress.begin_stage("fit to triangles", patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    if (scan.sides != nullptr) {
      const std::uint32_t side = side_of(*scan.sides, regions[p].points);
      cut_to_mesh(mesh, *scan.sides, side, spheres, patches[p]);
    } else if (scan.creases != nullptr) {
      fit_to_mesh(mesh, mesh.normals, spheres, patches[p]);
    } else {
      take_mesh_normals(mesh, mesh.normals, spheres.find_over(patches[p]), patches[p]);
    }
    progress.advance(1);
  });
  if (scan.sides != nullptr && !progress.cancelled()) thin_borders(patches);
}

/// Measures the first `count` points against the patches, and joins normals of those that meet.
Fidelity measure(const std::vector<glm::dvec3>& positions, std::size_t count,
                 const NeighbourGraph& graph, const std::vector<std::uint32_t>& owner,
                 PatchModel& model) {
  std::vector<double> distances;
  std::optional<SeamDistances> seams;
  // Stitching takes mostly one thread. It reads no normals of holes, which are what is joined.
  tbb::parallel_invoke(
      [&] {
        if (!model.joined.empty())
          seams.emplace(model.patches, make_seams(model.patches, model.joined.front().is_closed));
      },
      [&] {
        distances = distances_to_patches(positions, count, graph, owner, model.patches);
        join_normals(model);
      });
  if (seams) compare_with_seams(positions, model.patches, *seams, distances);
  return measure_fidelity(positions, distances, model.patches);
}

}  // namespace

Result<MeasuredModel> make_model(const PartitionedScan& scan, const ConvertOptions& options,
                                 std::optional<double> wanted, Progress& progress) {
  const bool seams = scan.creases != nullptr;
  const SampleBudget budget = budget_of(scan, options, wanted);
  const double spacing = options.spacing > 0.0
                             ? options.spacing
                             : choose_spacing(scan.samples, scan.graph, scan.regions,
                                              budget.factors, budget.samples, seams);
  const double area = area_of(scan.regions, budget.factors, scan.samples);
  RELIEF_TRY(check_spacing(spacing * scan.unit, area * scan.unit * scan.unit, scan.points.size()));
  const Membership membership = membership_of(scan.samples, scan.regions);
  std::vector<Region> regions = scan.regions;
  MeasuredModel made;
  FitCensus fits;
  made.model.patches = make_patches(
      {.samples = scan.samples,
       .graph = scan.graph,
       .membership = membership,
       .colours = scan.points.colours,
       .creases = scan.creases,
       .scalars = scan.points.scalars,
       .scalar_infos = scan.scalars,
       .border = scan.border,
       .follows_density = scan.follows_density,
       .is_cut_later = scan.sides != nullptr,
       .is_fitted_later = scan.spheres != nullptr && seams,
       .fits = &fits},
      budget.factors, resample_options(options, seams, spacing, scan.normals), regions, progress);
  std::vector<Patch>& patches = made.model.patches;
  if (progress.cancelled()) return interrupted_error();
  made.fits = fits.sum();
  if (patches.empty()) return make_error("the points are too scattered to be a surface");

  if (scan.spheres != nullptr) {
    take_mesh(scan, regions, patches, progress);
    if (progress.cancelled()) return interrupted_error();
  }
  if (scan.textured) {
    RELIEF_TRY(map_textures(scan.mesh, static_cast<std::uint32_t>(options.texels_per_cell), patches,
                            progress));
  }

  progress.begin_stage("measure", 0);
  if (seams)
    made.model.joined = {{0, static_cast<std::uint32_t>(patches.size()), scan.is_borderless}};
  made.model.spacing = spacing;
  made.model.scalars = scan.scalars;
  made.fidelity = measure(scan.scanned, scan.measured, scan.graph,
                          owners_of(regions, scan.points.size()), made.model);
  return made;
}

}  // namespace relief

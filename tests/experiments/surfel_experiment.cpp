// Measures [Textured surfels], section 3.3: gaps and overlap of surfels by the way of finding their
// sizes, on surfaces that are known and on meshes.
// usage: surfel_experiment POINTS SAMPLES [MESH...]
// Prints rows of a Markdown table.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "common/mesh/mesh_normals.h"
#include "preprocess/readers/read_points.h"
#include "renderer/geometry/meshes/mesh_of_points.h"
#include "renderer/surfels/surfels.h"
#include "tests/renderer/surfels/disc_coverage.h"
#include "tests/renderer/surfels/sampled_surfaces.h"

namespace relief::experiment {
namespace {

using test::DiscCoverage;
using test::SampledSurface;
using test::SurfaceSamples;

/// Evenly spread points of a mesh's triangles, with its smooth normals.
SurfaceSamples samples_of(const TriangleMesh& mesh, std::size_t count) {
  std::vector<double> sums;
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t[0]];
    sum += glm::length(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
    sums.push_back(sum);
  }
  SurfaceSamples samples;
  std::size_t triangle = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = sum * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (triangle + 1 < sums.size() && sums[triangle] < at) ++triangle;
    double a = std::fmod(0.5 + static_cast<double>(k) * 0.75487766624669276, 1.0);
    double b = std::fmod(0.5 + static_cast<double>(k) * 0.56984029099805327, 1.0);
    if (a + b > 1.0) {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const Triangle& t = mesh.triangles[triangle];
    samples.positions.push_back((1.0 - a - b) * mesh.positions[t[0]] + a * mesh.positions[t[1]] +
                                b * mesh.positions[t[2]]);
    samples.normals.push_back(glm::normalize((1.0 - a - b) * glm::dvec3(mesh.normals[t[0]]) +
                                             a * glm::dvec3(mesh.normals[t[1]]) +
                                             b * glm::dvec3(mesh.normals[t[2]])));
  }
  return samples;
}

void measure(const std::string& name, const SampledSurface& surface, const SurfaceSamples& truth) {
  for (const auto& [method_name, method] : kSurfelSizes) {
    if (method == SurfelSize::Given) continue;
    Progress none;
    const auto begin = std::chrono::steady_clock::now();
    const auto sizes = find_surfel_sizes(surface.positions, {}, method, none);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
    const DiscCoverage coverage(truth, surface.positions, surface.normals, sizes->diameters);
    const auto points = static_cast<double>(surface.positions.size());
    std::string closing;
    for (const double share : {1e-3, 1e-4, 1e-5, 0.0}) {
      const double scale = coverage.closing(share);
      closing += fmt::format(" {:.2f} ({:.1f}) |", scale, coverage.overlap(scale));
    }
    fmt::print("| {} | {} | {} | {:.0f} | {:.1f} | {:.3f} | {:.2f} |{}\n", name,
               surface.positions.size(), method_name, time.count(),
               100.0 * static_cast<double>(sizes->leftovers) / points,
               100.0 * coverage.uncovered(1.0), coverage.overlap(1.0), closing);
  }
}

}  // namespace
}  // namespace relief::experiment

int main(int count, char** arguments) {
  using namespace relief;
  if (count < 3) return EXIT_FAILURE;
  const auto points = static_cast<std::size_t>(std::atoll(arguments[1]));
  const auto samples = static_cast<std::size_t>(std::atoll(arguments[2]));
  fmt::print(
      "| surface | points | size | ms | leftovers, % | uncovered, % | overlap | to 0.1 % | to "
      "0.01 % | to 0.001 % | to 0 |\n|---|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  if (count == 3) {
    for (const test::Shape shape : test::kShapes) {
      for (const test::Sampling sampling : test::kSamplings) {
        experiment::measure(test::name_of(shape) + ", " + test::name_of(sampling),
                            test::sample_surface(shape, sampling, points, 1),
                            test::surface_truth(shape, samples));
      }
    }
  }
  std::fflush(stdout);
  for (int k = 3; k < count; ++k) {
    Progress none;
    auto scan = read_points(arguments[k], none, {});
    if (!scan) {
      fmt::print(stderr, "{}\n", scan.error().message);
      return EXIT_FAILURE;
    }
    const TriangleMesh mesh = mesh_of_points(scan->points);
    test::SampledSurface surface{mesh.positions, mesh.normals};
    experiment::measure(std::filesystem::path(arguments[k]).stem().string(), surface,
                        experiment::samples_of(mesh, samples));
  }
  return EXIT_SUCCESS;
}

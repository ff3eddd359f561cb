#include "preprocess/normals/normals.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "common/mesh/mesh_normals.h"
#include "preprocess/points/plane_fit.h"

namespace relief {
namespace {

// A neighbourhood whose smallest eigenvalue holds less than this share of the variance is flat
// enough: about 6 degrees of tilt over 8 neighbours.
constexpr double kFlatVariation = 0.01;

bool usable(glm::vec3 n) {
  const float length = glm::length(n);
  return std::isfinite(length) && length > 1e-12F;
}

// Points with unusable normals take their frame's, on the side of most neighbours. Passes until
// nothing changes, as neighbours may lack normals too.
void fill_missing(const Points& points, const NeighbourGraph& graph, const LocalFrames& frames,
                  std::vector<glm::vec3>& normals, std::vector<std::uint8_t>& missing) {
  std::vector<std::uint32_t> left;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (missing[i] != 0) left.push_back(i);
  }
  std::vector<std::uint32_t> filled;
  do {
    filled.clear();
    for (const std::uint32_t i : left) {
      float side = 0.0F;
      bool seen = false;
      for (const std::uint32_t j : graph.of(i)) {
        if (missing[j] != 0) continue;
        seen = true;
        side += glm::dot(normals[j], frames.normals[i]);
      }
      if (!seen) continue;
      normals[i] = side < 0.0F ? -frames.normals[i] : frames.normals[i];
      filled.push_back(i);
    }
    for (const std::uint32_t i : filled) missing[i] = 0;
    std::erase_if(left, [&](std::uint32_t i) { return missing[i] == 0; });
  } while (!filled.empty());
}

// The mean of the usable normals around a point; short where the neighbours disagree (thin sheets).
glm::vec3 neighbourhood_mean(const NeighbourGraph& graph, const std::vector<glm::vec3>& normals,
                             const std::vector<std::uint8_t>& missing, std::size_t i) {
  glm::vec3 sum(0.0F);
  float count = 0.0F;
  for (const std::uint32_t j : graph.of(i)) {
    if (missing[j] != 0) continue;
    sum += normals[j];
    count += 1.0F;
  }
  return count > 0.0F ? sum / count : sum;
}

// Whether a neighbour lies on the plane of a point's normal and has nearly the same: beside a sharp
// edge most neighbours may be of the other face.
bool has_a_face(const Points& points, const NeighbourGraph& graph,
                const std::vector<glm::vec3>& normals, std::size_t i) {
  constexpr float kAlike = 0.95F;
  constexpr double kInPlane = 0.1;
  return std::ranges::any_of(graph.of(i), [&](std::uint32_t j) {
    const glm::dvec3 between = points.positions[j] - points.positions[i];
    const double reach = kInPlane * glm::length(between);
    return glm::dot(normals[i], normals[j]) > kAlike &&
           std::abs(glm::dot(between, glm::dvec3(normals[i]))) < reach &&
           std::abs(glm::dot(between, glm::dvec3(normals[j]))) < reach;
  });
}

// Normals that oppose a consistent neighbourhood, or lie in its plane.
std::vector<std::uint8_t> find_inconsistent(const Points& points, const NeighbourGraph& graph,
                                            const LocalFrames& frames,
                                            const std::vector<std::uint8_t>& missing) {
  // Two flipped normals side by side look like a face, but one at an edge turns by less.
  constexpr float kFlipped = -0.9F;
  const std::vector<glm::vec3>& normals = points.normals;
  std::vector<std::uint8_t> inconsistent(normals.size(), 0);
  tbb::parallel_for(std::size_t{0}, normals.size(), [&](std::size_t i) {
    if (missing[i] != 0) return;
    const glm::vec3 mean = neighbourhood_mean(graph, normals, missing, i);
    const float length = glm::length(mean);
    const float along = glm::dot(normals[i], mean);
    const bool flat = frames.roughness[i] < 0.3F * graph.spacing[i];
    const bool against = length > 0.7F && along < 0.0F;
    const bool in_plane = flat && std::abs(glm::dot(normals[i], frames.normals[i])) < 0.3F;
    const bool flipped = against && along < kFlipped * length;
    const bool strange = (against || in_plane) && !has_a_face(points, graph, normals, i);
    inconsistent[i] = flipped || strange ? 1 : 0;
  });
  return inconsistent;
}

// Share of flat neighbour pairs whose normals oppose each other: near 0 when oriented, 0.5 when the
// signs are random, as from tools that only fit planes.
double opposed_pairs(const NeighbourGraph& graph, const LocalFrames& frames,
                     const std::vector<glm::vec3>& normals) {
  std::uint64_t pairs = 0;
  std::uint64_t opposed = 0;
  const std::size_t nearest = std::min<std::size_t>(4, graph.k);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (const std::uint32_t j : graph.of(i).first(nearest)) {
      if (std::abs(glm::dot(frames.normals[i], frames.normals[j])) < 0.9F) continue;
      ++pairs;
      if (glm::dot(normals[i], normals[j]) < 0.0F) ++opposed;
    }
  }
  return pairs > 0 ? static_cast<double>(opposed) / static_cast<double>(pairs) : 0.0;
}

// With more opposed pairs, the scan has no orientation to repair.
constexpr double kUnorientedShare = 0.1;

NormalsReport check_given(Points& points, const NeighbourGraph& graph, const LocalFrames& frames,
                          const SideChoice& side, const Progress& progress) {
  NormalsReport report;
  std::vector<std::uint8_t> missing(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    glm::vec3& n = points.normals[i];
    missing[i] = usable(n) ? 0 : 1;
    n = missing[i] != 0 ? glm::vec3(0.0F) : glm::normalize(n);
  }
  std::vector<std::uint8_t> repaired = missing;
  fill_missing(points, graph, frames, points.normals, missing);
  report.oriented = side.side != NormalSide::Auto ||
                    opposed_pairs(graph, frames, points.normals) > kUnorientedShare;
  if (report.oriented) {
    const std::vector<glm::vec3> before = points.normals;
    orient_normals(points, graph, side, points.normals, progress);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (glm::dot(before[i], points.normals[i]) < 0.0F) repaired[i] = 1;
    }
  }
  std::vector<std::uint8_t> inconsistent = find_inconsistent(points, graph, frames, missing);
  for (std::size_t i = 0; i < points.size(); ++i) repaired[i] |= inconsistent[i];
  fill_missing(points, graph, frames, points.normals, inconsistent);
  report.repaired =
      static_cast<std::uint64_t>(std::count(repaired.begin(), repaired.end(), std::uint8_t{1}));
  return report;
}

bool has_normal(const Points& points) {
  return std::any_of(points.normals.begin(), points.normals.end(), usable);
}

}  // namespace

LocalFrames fit_local_frames(const std::vector<glm::dvec3>& positions,
                             const NeighbourGraph& graph) {
  LocalFrames frames;
  frames.normals.assign(positions.size(), glm::vec3(0.0F));
  frames.roughness.resize(positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) {
    const auto neighbours = graph.of(i);
    PlaneFit best = fit_plane(positions, i, neighbours.first(std::min<std::size_t>(8, graph.k)));
    if (best.variation > kFlatVariation && graph.k > 8) {
      const PlaneFit wide = fit_plane(positions, i, neighbours);
      if (wide.variation < best.variation) best = wide;
    }
    frames.normals[i] = glm::vec3(best.normal);
    frames.roughness[i] = static_cast<float>(best.rms);
  });
  return frames;
}

std::vector<glm::vec3> normals_of_faces(const Points& points, const MeshEdges& edges) {
  if (points.triangles.empty() || has_normal(points) || edges.misoriented() >= kMaxMisoriented)
    return {};
  return normals_from_triangles(points);
}

void take_known_normals(const std::vector<glm::vec3>& known, LocalFrames& frames) {
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != glm::vec3(0.0F)) frames.normals[i] = known[i];
  }
}

NormalsReport complete_normals(Points& points, const NeighbourGraph& graph,
                               const LocalFrames& frames, const NormalsOptions& options,
                               const Progress& progress) {
  NormalsReport report;
  report.estimated = true;
  if (options.are_of_faces) return report;
  if (has_normal(points)) return check_given(points, graph, frames, options.side, progress);

  std::vector<glm::vec3> normals =
      options.of_faces != nullptr ? *options.of_faces : normals_of_faces(points, MeshEdges(points));
  if (!normals.empty()) {
    points.normals = std::move(normals);
    std::vector<std::uint8_t> missing(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) missing[i] = usable(points.normals[i]) ? 0 : 1;
    fill_missing(points, graph, frames, points.normals, missing);
    // Vertices without any oriented neighbour (islands without faces).
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (missing[i] != 0) points.normals[i] = frames.normals[i];
    }
  } else {
    points.normals = frames.normals;
    report.oriented = true;
    orient_normals(points, graph, options.side, points.normals, progress);
  }
  return report;
}

std::vector<glm::vec3> smooth_normals(const std::vector<glm::vec3>& normals,
                                      const NeighbourGraph& graph) {
  std::vector<glm::vec3> smooth(normals.size());
  tbb::parallel_for(std::size_t{0}, normals.size(), [&](std::size_t i) {
    glm::vec3 sum = normals[i];
    for (const std::uint32_t j : graph.of(i)) {
      if (glm::dot(normals[i], normals[j]) > 0.0F) sum += normals[j];
    }
    smooth[i] = glm::normalize(sum);
  });
  return smooth;
}

}  // namespace relief

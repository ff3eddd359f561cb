#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <queue>

#include "preprocess/normal_spread.h"
#include "preprocess/partition.h"

namespace relief {
namespace {

constexpr std::uint32_t kNoCluster = 0xFFFFFFFFU;

// The neighbours that make a border between two regions.
constexpr std::uint32_t kBorderNeighbours = 8;

// A union of more points is first tried by the outermost normals, which takes as long as the test of
// some hundreds of points. (On the Dragon the others are a tenth of all the points that are tried.)
constexpr std::size_t kManyPoints = 400;

constexpr double kCompactnessWeight = 0.01;
constexpr double kSizeWeight = 2.0;

/// The lengths of a cluster's borders with its neighbours: few, so a list does, by their numbers.
class Borders {
 public:
  struct Border {
    std::uint32_t other;
    double length;
  };

  double& operator[](std::uint32_t other) {
    const auto at = place_of(other);
    if (at != list_.end() && at->other == other) return at->length;
    return list_.insert(at, {other, 0.0})->length;
  }

  void erase(std::uint32_t other) {
    const auto at = place_of(other);
    if (at != list_.end() && at->other == other) list_.erase(at);
  }

  [[nodiscard]] auto begin() const { return list_.begin(); }
  [[nodiscard]] auto end() const { return list_.end(); }

 private:
  std::vector<Border>::iterator place_of(std::uint32_t other) {
    return std::lower_bound(list_.begin(), list_.end(), other,
                            [](const Border& b, std::uint32_t o) { return b.other < o; });
  }

  std::vector<Border> list_;
};

// A region while it grows.
struct Cluster {
  Region region;
  double area = 0.0;             // sum of squared local spacings
  glm::dvec3 area_normal{0.0};   // sum of those times normals
  double perimeter = 0.0;        // sum of `borders`
  Borders borders;
  std::unique_ptr<NormalSpread> spread;  // once it was asked for
  std::uint32_t version = 0;
};

struct Candidate {
  double cost;
  std::uint32_t a;
  std::uint32_t b;
  std::uint32_t version_a;
  std::uint32_t version_b;

  bool operator<(const Candidate& o) const {  // std::priority_queue wants the best last
    if (cost != o.cost) return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

class Merger {
 public:
  Merger(const SurfaceSamples& samples, const NeighbourGraph& graph, const MergeRule& rule,
         std::vector<Region> regions)
      : samples_(samples),
        test_(samples, rule.limits),
        cos_cone_(std::cos(glm::radians(rule.limits.cone_degrees))),
        small_points_(rule.small_points) {
    clusters_.resize(regions.size());
    std::vector<std::uint32_t> owner(samples.positions.size(), kNoCluster);
    for (std::uint32_t c = 0; c < regions.size(); ++c) {
      for (const std::uint32_t i : regions[c].points) {
        const double a = double{samples.spacing[i]} * samples.spacing[i];
        owner[i] = c;
        clusters_[c].area += a;
        clusters_[c].area_normal += a * glm::dvec3(samples.normals[i]);
      }
      total_area_ += clusters_[c].area;
      clusters_[c].region = std::move(regions[c]);
    }
    for (std::uint32_t i = 0; i < owner.size(); ++i) add_borders(graph, owner, i);
    for (Cluster& cluster : clusters_) {
      for (const auto& [other, length] : cluster.borders) cluster.perimeter += length;
    }
    for (std::uint32_t c = 0; c < clusters_.size(); ++c) push_candidates(c, true);
  }

  std::vector<Region> run(Progress& progress) {
    progress.begin_stage("merge", clusters_.size());
    while (!queue_.empty() && !progress.cancelled()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (clusters_[best.a].version != best.version_a ||
          clusters_[best.b].version != best.version_b) {
        continue;
      }
      if (try_merge(best.a, best.b)) progress.advance(1);
    }
    std::vector<Region> out;
    for (Cluster& cluster : clusters_) {
      if (!cluster.region.points.empty()) out.push_back(std::move(cluster.region));
    }
    return out;
  }

 private:
  void add_borders(const NeighbourGraph& graph, const std::vector<std::uint32_t>& owner,
                   std::uint32_t i) {
    const std::uint32_t a = owner[i];
    if (a == kNoCluster) return;
    const std::size_t near = std::min<std::size_t>(kBorderNeighbours, graph.k);
    for (const std::uint32_t j : graph.of(i).first(near)) {
      const std::uint32_t b = owner[j];
      if (b == a || b == kNoCluster) continue;
      if (!on_one_sheet(samples_, i, j)) continue;
      // A point beside a straight border has about 3 of its 8 neighbours beyond it; both sides
      // count.
      const double length = double{samples_.spacing[i]} / 6.0;
      clusters_[a].borders[b] += length;
      clusters_[b].borders[a] += length;
    }
  }

  // Lower is better. Flatness: share of the union's area that its mean normal loses (0 for a
  // plane). Compactness: perimeter squared over 4 pi area (1 for a disc). Size: the square root of
  // its share of the model keeps all patches growing alike. The weights were chosen on Dragon, Igea
  // and Lucy for few patches of compact shape (docs/decisions.md).
  [[nodiscard]] double cost(std::uint32_t ia, std::uint32_t ib, double border) const {
    const Cluster& a = clusters_[ia];
    const Cluster& b = clusters_[ib];
    const double area = a.area + b.area;
    const double flatness = 1.0 - glm::length(a.area_normal + b.area_normal) / area;
    const double perimeter = std::max(a.perimeter + b.perimeter - 2.0 * border, 0.0);
    const double compactness = perimeter * perimeter / (4.0 * std::numbers::pi * area);
    return flatness + kCompactnessWeight * compactness +
           kSizeWeight * std::sqrt(area / total_area_);
  }

  void push_candidates(std::uint32_t c, bool only_higher) {
    for (const auto& [other, border] : clusters_[c].borders) {
      if (only_higher && other < c) continue;
      if (std::min(clusters_[c].region.points.size(), clusters_[other].region.points.size()) >=
          small_points_) {
        continue;
      }
      const std::uint32_t a = std::min(c, other);
      const std::uint32_t b = std::max(c, other);
      queue_.push({cost(a, b, border), a, b, clusters_[a].version, clusters_[b].version});
    }
  }

  const NormalSpread& spread_of(Cluster& cluster) {
    if (!cluster.spread)
      cluster.spread = std::make_unique<NormalSpread>(samples_.normals, cluster.region.points);
    return *cluster.spread;
  }

  bool try_merge(std::uint32_t ia, std::uint32_t ib) {
    if (clusters_[ia].region.points.size() < clusters_[ib].region.points.size()) std::swap(ia, ib);
    Cluster& a = clusters_[ia];
    Cluster& b = clusters_[ib];
    const bool many = a.region.points.size() + b.region.points.size() > kManyPoints;
    if (many && NormalSpread::exceed(spread_of(a), spread_of(b), cos_cone_)) return false;
    std::vector<std::uint32_t> points(a.region.points.size() + b.region.points.size());
    std::merge(a.region.points.begin(), a.region.points.end(), b.region.points.begin(),
               b.region.points.end(), points.begin());
    const auto normal = test_.fit(points);
    if (!normal) return false;

    a.region = {std::move(points), *normal};
    if (many) {
      a.spread->add(*b.spread);
    } else {
      a.spread.reset();
    }
    a.area += b.area;
    a.area_normal += b.area_normal;
    a.perimeter = std::max(a.perimeter + b.perimeter - 2.0 * b.borders[ia], 0.0);
    for (const auto& [other, length] : b.borders) {
      if (other == ia) continue;
      a.borders[other] += length;
      auto& back = clusters_[other].borders;
      back[ia] += length;
      back.erase(ib);
    }
    a.borders.erase(ib);
    ++a.version;
    const std::uint32_t next_version = b.version + 1;
    b = Cluster{};
    b.version = next_version;
    push_candidates(ia, false);
    return true;
  }

  SurfaceSamples samples_;
  RegionTest test_;
  double cos_cone_;
  std::size_t small_points_;
  std::vector<Cluster> clusters_;
  std::priority_queue<Candidate> queue_;
  double total_area_ = 0.0;
};

}  // namespace

std::vector<Region> merge(const SurfaceSamples& samples, const NeighbourGraph& graph,
                          std::vector<Region> regions, const MergeRule& rule, Progress& progress) {
  return Merger(samples, graph, rule, std::move(regions)).run(progress);
}

}  // namespace relief

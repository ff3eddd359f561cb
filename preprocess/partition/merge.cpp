#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <optional>

#include "preprocess/normals/crease_sides.h"
#include "preprocess/partition/borders.h"
#include "preprocess/partition/candidate_queue.h"
#include "preprocess/partition/normal_spread.h"
#include "preprocess/partition/partition.h"

namespace relief {
namespace {

constexpr std::uint32_t kNoCluster = 0xFFFFFFFFU;

// Larger unions are first tested by their outermost normals, which takes as long as testing some
// hundreds of points. (On the Dragon, smaller unions have a tenth of all tested points.)
constexpr std::size_t kManyPoints = 400;

// Number of best pairs that are tested in parallel. Pays off in the first thousands of merges, at
// about 5 us each; later tests are invalidated by earlier merges.
constexpr std::size_t kMaxTrials = 32;
constexpr std::size_t kMinTrials = 4;

// Regions stay apart if more than this share of their border is a crease.
constexpr double kCreaseShare = 0.5;

constexpr double kCompactnessWeight = 0.01;
constexpr double kSizeWeight = 2.0;

// A growing region.
struct Cluster {
  Region region;
  double area = 0.0;            // sum of squared local spacings
  glm::dvec3 area_normal{0.0};  // sum of those times normals
  double perimeter = 0.0;       // sum of `borders`
  Borders borders;
  Borders creases;                       // what of them is at creases
  std::unique_ptr<NormalSpread> spread;  // computed on demand
  std::uint32_t version = 0;
};

/// The result of testing a pair.
struct Trial {
  Candidate candidate;
  std::vector<std::uint32_t> points;  // of the union, if it was made
  std::optional<glm::vec3> normal;    // of its base plane, if the union passes
};

class Merger {
 public:
  Merger(const SurfaceSamples& samples, const NeighbourGraph& graph, const MergeRule& rule,
         std::vector<Region> regions)
      : samples_(samples),
        tests_([samples, limits = rule.limits] { return RegionTest(samples, limits); }),
        cos_cone_(std::cos(glm::radians(rule.limits.cone_degrees))),
        at_crease_(rule.at_crease),
        small_points_(rule.small_points) {
    clusters_.resize(regions.size());
    alive_ = regions.size();
    std::vector<std::uint32_t> owner(samples.positions.size(), kNoCluster);
    tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t c) {
      Cluster& cluster = clusters_[c];
      cluster.region = std::move(regions[c]);
      for (const std::uint32_t i : cluster.region.points) {
        const double a = double{samples.spacing[i]} * samples.spacing[i];
        owner[i] = static_cast<std::uint32_t>(c);
        cluster.area += a;
        cluster.area_normal += a * glm::dvec3(samples.normals[i]);
      }
    });
    for (const Cluster& cluster : clusters_) total_area_ += cluster.area;
    add_borders(graph, owner);
    for (Cluster& cluster : clusters_) {
      for (const auto& [other, length] : cluster.borders) cluster.perimeter += length;
    }
    for (std::uint32_t c = 0; c < clusters_.size(); ++c) push_candidates(c, true);
  }

  std::vector<Region> run(Progress& progress) {
    progress.begin_stage("merge", clusters_.size());
    const std::size_t threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    std::vector<Trial> trials;  // tested ahead of their turn, in order
    std::size_t next = 0;
    while (!progress.cancelled()) {
      if (next == trials.size()) {
        trials = take_best(threads > 1 ? std::clamp(alive_ / 64, kMinTrials, kMaxTrials) : 1);
        next = 0;
        if (trials.empty()) break;
        try_all(trials);
      }
      // Pairs made possible by merges since these tests may be better.
      const Candidate* best = best_candidate();
      if (best != nullptr && trials[next].candidate.is_worse_than(*best)) {
        std::vector<Trial> better = take_best(1);
        try_all(better);
        if (settle(better.front())) progress.advance(1);
      } else if (settle(trials[next++])) {
        progress.advance(1);
      }
    }
    std::vector<Region> out;
    for (Cluster& cluster : clusters_) {
      if (!cluster.region.points.empty()) out.push_back(std::move(cluster.region));
    }
    return out;
  }

 private:
  /// What a cluster's own points tell of its borders.
  struct OwnBorders {
    Borders all;
    Borders creases;
  };

  void add_borders(const NeighbourGraph& graph, const std::vector<std::uint32_t>& owner) {
    const std::size_t near = std::min<std::size_t>(kBorderNeighbours, graph.k);
    std::vector<OwnBorders> own(clusters_.size());
    tbb::parallel_for(std::size_t{0}, clusters_.size(), [&](std::size_t c) {
      for (const std::uint32_t i : clusters_[c].region.points) {
        for (const std::uint32_t j : graph.of(i).first(near)) {
          if (owner[j] == c || owner[j] == kNoCluster || !on_one_sheet(samples_, i, j)) continue;
          // A point at a straight border has about 3 of its 8 neighbours beyond it; both sides
          // count.
          const double length = double{samples_.spacing[i]} / 6.0;
          own[c].all[owner[j]] += length;
          if (is_crease(i, j)) own[c].creases[owner[j]] += length;
        }
      }
    });
    for (std::uint32_t c = 0; c < clusters_.size(); ++c) {
      for (const auto& [other, length] : own[c].all)
        add_to_both(c, other, &Cluster::borders, length);
      for (const auto& [other, length] : own[c].creases)
        add_to_both(c, other, &Cluster::creases, length);
    }
  }

  void add_to_both(std::uint32_t a, std::uint32_t b, Borders Cluster::*kind, double length) {
    (clusters_[a].*kind)[b] += length;
    (clusters_[b].*kind)[a] += length;
  }

  [[nodiscard]] bool is_crease(std::uint32_t i, std::uint32_t j) const {
    return at_crease_ != nullptr && (*at_crease_)[i] != 0 && (*at_crease_)[j] != 0 &&
           glm::dot(samples_.normals[i], samples_.normals[j]) < kCreaseTurnCosine;
  }

  /// Whether most of the border between two clusters is a crease.
  [[nodiscard]] bool meet_at_crease(std::uint32_t a, std::uint32_t b, double border) const {
    return at_crease_ != nullptr && clusters_[a].creases.length_to(b) > kCreaseShare * border;
  }

  // Lower is better. Flatness: share of the union's area that its mean normal loses (0 for a
  // plane). Compactness: perimeter squared over 4 pi area (1 for a disc). Size: the square root of
  // its share of the model keeps all patches growing alike. The weights were chosen on Dragon, Igea
  // and Lucy for few patches of compact shape (docs/decisions/0028).
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
      if (meet_at_crease(c, other, border)) continue;
      const std::uint32_t a = std::min(c, other);
      const std::uint32_t b = std::max(c, other);
      queue_.push({cost(a, b, border), a, b, clusters_[a].version, clusters_[b].version});
    }
  }

  [[nodiscard]] bool is_current(const Candidate& c) const {
    return clusters_[c.a].version == c.version_a && clusters_[c.b].version == c.version_b;
  }

  [[nodiscard]] const Candidate* best_candidate() {
    return queue_.best([this](const Candidate& c) { return is_current(c); });
  }

  /// Removes up to `count` of the best candidates.
  std::vector<Trial> take_best(std::size_t count) {
    std::vector<Trial> trials;
    while (trials.size() < count) {
      const Candidate* best = best_candidate();
      if (best == nullptr) break;
      trials.push_back({*best, {}, {}});
      queue_.pop();
    }
    return trials;
  }

  [[nodiscard]] bool is_many(const Candidate& c) const {
    return clusters_[c.a].region.points.size() + clusters_[c.b].region.points.size() > kManyPoints;
  }

  /// Computes the spreads that these trials need and that are not known yet.
  void find_spreads(const std::vector<Trial>& trials) {
    std::vector<std::uint32_t> unknown;
    for (const Trial& trial : trials) {
      if (!is_many(trial.candidate)) continue;
      for (const std::uint32_t c : {trial.candidate.a, trial.candidate.b}) {
        if (!clusters_[c].spread) unknown.push_back(c);
      }
    }
    std::ranges::sort(unknown);
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    tbb::parallel_for(std::size_t{0}, unknown.size(), [&](std::size_t k) {
      Cluster& cluster = clusters_[unknown[k]];
      cluster.spread = std::make_unique<NormalSpread>(samples_.normals, cluster.region.points);
    });
  }

  void try_all(std::vector<Trial>& trials) {
    find_spreads(trials);
    if (trials.size() == 1) return try_union(trials.front());
    tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t t) { try_union(trials[t]); });
  }

  void try_union(Trial& trial) {
    const Cluster& a = clusters_[trial.candidate.a];
    const Cluster& b = clusters_[trial.candidate.b];
    if (is_many(trial.candidate) && NormalSpread::exceed(*a.spread, *b.spread, cos_cone_)) return;
    trial.points.resize(a.region.points.size() + b.region.points.size());
    std::merge(a.region.points.begin(), a.region.points.end(), b.region.points.begin(),
               b.region.points.end(), trial.points.begin());
    trial.normal = tests_.local().fit(trial.points);
  }

  /// Merges the pair if it passes and is still current.
  bool settle(Trial& trial) {
    if (!trial.normal || !is_current(trial.candidate)) return false;
    std::uint32_t ia = trial.candidate.a;
    std::uint32_t ib = trial.candidate.b;
    if (clusters_[ia].region.points.size() < clusters_[ib].region.points.size()) std::swap(ia, ib);
    Cluster& a = clusters_[ia];
    Cluster& b = clusters_[ib];
    if (is_many(trial.candidate)) {
      a.spread->add(*b.spread);
    } else {
      a.spread.reset();
    }
    a.region = {std::move(trial.points), *trial.normal};
    a.area += b.area;
    a.area_normal += b.area_normal;
    a.perimeter = std::max(a.perimeter + b.perimeter - 2.0 * b.borders[ia], 0.0);
    for (Borders Cluster::*const kind : {&Cluster::borders, &Cluster::creases}) {
      for (const auto& [other, length] : b.*kind) {
        if (other == ia) continue;
        (a.*kind)[other] += length;
        Borders& back = clusters_[other].*kind;
        back[ia] += length;
        back.erase(ib);
      }
      (a.*kind).erase(ib);
    }
    ++a.version;
    const std::uint32_t next_version = b.version + 1;
    b = Cluster{};
    b.version = next_version;
    --alive_;
    push_candidates(ia, false);
    return true;
  }

  SurfaceSamples samples_;
  tbb::enumerable_thread_specific<RegionTest> tests_;
  double cos_cone_;
  const std::vector<std::uint8_t>* at_crease_;
  std::size_t small_points_;
  std::vector<Cluster> clusters_;
  CandidateQueue queue_;
  std::size_t alive_ = 0;
  double total_area_ = 0.0;
};

}  // namespace

std::vector<Region> merge(const SurfaceSamples& samples, const NeighbourGraph& graph,
                          std::vector<Region> regions, const MergeRule& rule, Progress& progress) {
  return Merger(samples, graph, rule, std::move(regions)).run(progress);
}

}  // namespace relief

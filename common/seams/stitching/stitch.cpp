#include "common/seams/stitching/stitch.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <queue>

#include "common/seams/stitching/fill_loops.h"
#include "common/seams/stitching/front.h"
#include "common/seams/stitching/growth_rules.h"
#include "common/seams/vertex_grid.h"

namespace relief {
namespace {

using Vertex = Front::Vertex;

// Candidates that are looked at together: this share of all, and so many at most. What a round adds
// suggests the next, which may be better than the rest of the round.
constexpr std::size_t kRounds = 64;
constexpr std::size_t kLargestRound = 64;
// Fewer take less time than another thread takes to begin.
constexpr std::size_t kFew = 8;

/// The order of a queue whose top is the best. No two in it are on the same edge, so it does not
/// matter in which order they come.
struct IsWorse {
  [[nodiscard]] bool operator()(const GrowthCandidate& a, const GrowthCandidate& b) const {
    if (a.score != b.score) return a.score > b.score;
    if (a.from != b.from) return a.from > b.from;
    return a.to > b.to;
  }
};

/// Grows triangles from the border until none is left that may be added.
class Growth {
 public:
  explicit Growth(Front& front)
      : front_(front),
        grid_(front.vertices(), [&front](Vertex v) { return front.is_live(v); }),
        rules_(front, grid_),
        first_(first_candidates()) {}

  /// Looks at the best candidates in parallel, settles them one by one, and looks for what they
  /// leave behind in parallel.
  void grow() {
    while (true) {
      const std::vector<GrowthCandidate> round = take_best(round_size());
      if (round.empty()) return;
      const std::vector<Look> looks = look_at(round);
      std::vector<Base> bases;
      moved_.clear();
      for (std::size_t k = 0; k < round.size(); ++k) settle(round[k], looks[k], bases);
      suggest_on(bases);
    }
  }

 private:
  /// A border edge.
  struct Base {
    Vertex from = 0;
    Vertex to = 0;
  };

  /// A candidate at the beginning of its round.
  struct Look {
    bool is_good = false;
    GrowthRules::Surroundings around;
  };

  /// It does not depend on the number of threads, so that the triangles do not.
  [[nodiscard]] std::size_t round_size() const {
    return std::clamp((first_.size() + queue_.size()) / kRounds, std::size_t{1}, kLargestRound);
  }

  [[nodiscard]] bool is_good(const GrowthCandidate& c) const {
    const std::optional<double> score = rules_.score_of(c.from, c.to, c.apex);
    return score && *score <= c.score && rules_.is_free(c.from, c.to, c.apex);
  }

  /// Looks at candidates before any of them is added.
  [[nodiscard]] std::vector<Look> look_at(const std::vector<GrowthCandidate>& round) const {
    std::vector<Look> looks(round.size());
    for_each_of(round.size(), [&](std::size_t k) {
      const GrowthCandidate& c = round[k];
      if (!front_.is_open(c.from, c.to)) return;
      looks[k] = {is_good(c), rules_.surroundings_of(c.from, c.to, c.apex)};
    });
    return looks;
  }

  /// Whether an edge of something that this round has added is near.
  [[nodiscard]] bool has_changed(const GrowthRules::Surroundings& around) const {
    return std::ranges::any_of(moved_, [&](Vertex v) {
      const glm::dvec3 d = front_.vertex(v).position - around.middle;
      const double near = around.radius + 0.5 * front_.longest_at(v);
      return glm::dot(d, d) <= near * near;
    });
  }

  /// Adds a candidate if it is good, and lists the border edges that may bear another triangle.
  void settle(const GrowthCandidate& c, const Look& look, std::vector<Base>& bases) {
    if (!front_.is_open(c.from, c.to)) return;
    const bool good = has_changed(look.around) ? is_good(c) : look.is_good;
    if (!good) return bases.push_back({c.from, c.to});  // something has changed since
    front_.attach(c.from, c.to, c.apex);
    moved_.insert(moved_.end(), {c.from, c.to, c.apex});
    if (front_.is_open(c.from, c.apex)) bases.push_back({c.from, c.apex});
    if (front_.is_open(c.apex, c.to)) bases.push_back({c.apex, c.to});
  }

  /// Puts the best triangle on each of these border edges into the queue, if there is one.
  void suggest_on(const std::vector<Base>& bases) {
    std::vector<std::optional<GrowthCandidate>> best(bases.size());
    for_each_of(bases.size(), [&](std::size_t k) {
      // A later one of the round may have closed it.
      if (front_.is_open(bases[k].from, bases[k].to))
        best[k] = rules_.best_on(bases[k].from, bases[k].to);
    });
    for (const std::optional<GrowthCandidate>& candidate : best) {
      if (candidate) queue_.push(*candidate);
    }
  }

  template <class Fn>
  static void for_each_of(std::size_t count, const Fn& fn) {
    if (count < kFew) {
      for (std::size_t k = 0; k < count; ++k) fn(k);
      return;
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kFew), [&](const auto& range) {
      for (std::size_t k = range.begin(); k != range.end(); ++k) fn(k);
    });
  }

  /// The best triangle of each border edge, the best of all last.
  [[nodiscard]] std::vector<GrowthCandidate> first_candidates() const {
    tbb::enumerable_thread_specific<std::vector<GrowthCandidate>> found;
    const auto count = static_cast<Vertex>(front_.vertices().size());
    tbb::parallel_for(tbb::blocked_range<Vertex>(0, count), [&](const auto& range) {
      std::vector<GrowthCandidate>& own = found.local();
      for (Vertex v = range.begin(); v != range.end(); ++v) {
        for (const Front::Edge& edge : front_.at(v)) {
          if (!edge.outward) continue;
          if (const auto best = rules_.best_on(v, edge.other)) own.push_back(*best);
        }
      }
    });
    std::vector<GrowthCandidate> all;
    for (const std::vector<GrowthCandidate>& own : found)
      all.insert(all.end(), own.begin(), own.end());
    tbb::parallel_sort(all.begin(), all.end(), IsWorse());
    return all;
  }

  /// Removes the best candidates, up to `count`.
  std::vector<GrowthCandidate> take_best(std::size_t count) {
    std::vector<GrowthCandidate> best;
    best.reserve(count);
    while (best.size() < count && !(first_.empty() && queue_.empty())) {
      const bool queued =
          !queue_.empty() && (first_.empty() || IsWorse()(first_.back(), queue_.top()));
      best.push_back(queued ? queue_.top() : first_.back());
      queued ? queue_.pop() : first_.pop_back();
    }
    return best;
  }

  Front& front_;
  VertexGrid grid_;
  GrowthRules rules_;
  // Sorted once: a queue of all would be read from memory, a queue of the rest is small.
  std::vector<GrowthCandidate> first_;
  std::priority_queue<GrowthCandidate, std::vector<GrowthCandidate>, IsWorse> queue_;
  std::vector<Vertex> moved_;  ///< corners of the triangles that this round has added
};

}  // namespace

std::vector<Triangle> stitch(const BorderMesh& mesh, bool is_closed) {
  Front front(mesh);
  Growth(front).grow();
  fill_loops(front, is_closed);
  return front.take();
}

}  // namespace relief

#include "common/seams/stitching/stitch.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <optional>
#include <queue>

#include "common/seams/stitching/fill_loops.h"
#include "common/seams/stitching/front.h"
#include "common/seams/stitching/growth_rules.h"
#include "common/seams/vertex_grid.h"

namespace relief {
namespace {

using Vertex = Front::Vertex;

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

  void grow() {
    while (const std::optional<GrowthCandidate> taken = take_best()) {
      const GrowthCandidate& best = *taken;
      if (!front_.is_open(best.from, best.to)) continue;
      const std::optional<double> score = rules_.score_of(best.from, best.to, best.apex);
      if (score && *score <= best.score && rules_.is_free(best.from, best.to, best.apex)) {
        front_.attach(best.from, best.to, best.apex);
        if (front_.is_open(best.from, best.apex)) suggest(best.from, best.apex);
        if (front_.is_open(best.apex, best.to)) suggest(best.apex, best.to);
      } else {
        suggest(best.from, best.to);  // something has changed since
      }
    }
  }

 private:
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

  std::optional<GrowthCandidate> take_best() {
    const bool queued =
        !queue_.empty() && (first_.empty() || IsWorse()(first_.back(), queue_.top()));
    if (!queued && first_.empty()) return {};
    const GrowthCandidate best = queued ? queue_.top() : first_.back();
    queued ? queue_.pop() : first_.pop_back();
    return best;
  }

  /// Puts the best triangle on a border edge into the queue, if there is one.
  void suggest(Vertex from, Vertex to) {
    if (const std::optional<GrowthCandidate> best = rules_.best_on(from, to)) queue_.push(*best);
  }

  Front& front_;
  VertexGrid grid_;
  GrowthRules rules_;
  // Sorted once: a queue of all would be read from memory, a queue of the rest is small.
  std::vector<GrowthCandidate> first_;
  std::priority_queue<GrowthCandidate, std::vector<GrowthCandidate>, IsWorse> queue_;
};

}  // namespace

std::vector<Triangle> stitch(const BorderMesh& mesh, bool is_closed) {
  Front front(mesh);
  Growth(front).grow();
  fill_loops(front, is_closed);
  return front.take();
}

}  // namespace relief

#include "preprocess/normals/side_energy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace relief {
namespace {

using Index = Eigen::Index;
constexpr Index kNoGroup = -1;

/// The fields as one more piece, the last, whose side is 1: an energy of -s . pairs . s / 2.
SideEnergy with_outside(const SideEnergy& energy) {
  const Index count = energy.fields.size();
  SideEnergy all{Eigen::MatrixXf::Zero(count + 1, count + 1), {}, Eigen::VectorXf(count + 1)};
  all.pairs.topLeftCorner(count, count) = energy.pairs;
  all.pairs.col(count).head(count) = energy.fields;
  all.pairs.row(count).head(count) = energy.fields.transpose();
  all.areas.head(count) = energy.areas;
  all.areas[count] = std::numeric_limits<float>::max();
  return all;
}

/// Groups of pieces, each joined from two others, up to the one of all pieces.
struct GroupTree {
  struct Join {
    std::vector<Index> first;  ///< pieces of one group
    std::vector<Index> second;
    std::size_t parts[2];  ///< the groups: a piece, or their number plus that of their join
  };
  std::vector<Join> joins;  ///< in their order
  Eigen::VectorXf sides;    ///< of all pieces
};

class Contraction {
 public:
  explicit Contraction(const SideEnergy& energy)
      : pairs_(energy.pairs),
        areas_(energy.areas),
        partner_(static_cast<std::size_t>(areas_.size())),
        members_(partner_.size()),
        node_(partner_.size()) {
    tree_.sides = Eigen::VectorXf::Ones(areas_.size());
    for (Index a = 0; a < areas_.size(); ++a) {
      members(a) = {a};
      node_[static_cast<std::size_t>(a)] = static_cast<std::size_t>(a);
      alive_.push_back(a);
    }
    for (const Index a : alive_) find_partner(a);
  }

  GroupTree run() {
    while (alive_.size() > 1) join_surest();
    return std::move(tree_);
  }

 private:
  /// The group that one is surest of.
  struct Partner {
    Index group = kNoGroup;
    float sureness = 0.0F;  ///< at least that of all others
    bool is_stale = false;  ///< the group is gone, or less sure now
  };

  std::vector<Index>& members(Index a) { return members_[static_cast<std::size_t>(a)]; }
  Partner& partner(Index a) { return partner_[static_cast<std::size_t>(a)]; }

  // Pairs are symmetric. A column lies in one piece: `a` changes less often than `b`.
  [[nodiscard]] float sureness(Index a, Index b) const {
    return std::abs(pairs_(b, a)) / std::min(areas_[a], areas_[b]);
  }

  void find_partner(Index a) {
    Partner best;
    for (const Index b : alive_) {
      if (b == a) continue;
      const float own = sureness(a, b);
      if (best.group == kNoGroup || own > best.sureness) best = {b, own, false};
    }
    partner(a) = best;
  }

  void join_surest() {
    Index surest = find_surest();
    for (; partner(surest).is_stale; surest = find_surest()) find_partner(surest);
    const Index other = partner(surest).group;
    join(std::min(surest, other), std::max(surest, other));
  }

  Index find_surest() {
    Index surest = alive_.front();
    for (const Index a : alive_) {
      if (partner(a).sureness > partner(surest).sureness) surest = a;
    }
    return surest;
  }

  void join(Index gone, Index kept) {
    const float sign = pairs_(gone, kept) < 0.0F ? -1.0F : 1.0F;
    for (const Index piece : members(gone)) tree_.sides[piece] *= sign;
    std::size_t& node = node_[static_cast<std::size_t>(kept)];
    tree_.joins.push_back(
        {members(gone), members(kept), {node_[static_cast<std::size_t>(gone)], node}});
    node = node_.size() + tree_.joins.size() - 1;
    members(kept).insert(members(kept).end(), members(gone).begin(), members(gone).end());
    pairs_.col(kept) += sign * pairs_.col(gone);
    pairs_.row(kept) = pairs_.col(kept).transpose();
    pairs_(kept, kept) = 0.0F;
    areas_[kept] += areas_[gone];
    alive_.erase(std::ranges::lower_bound(alive_, gone));
    find_partner(kept);
    // Most pieces couple to a few large groups, which each join changes: looking for all of their
    // partners at once took 0.8 s of a scan's 6.
    for (const Index a : alive_) {
      if (a == kept) continue;
      if (const float own = sureness(kept, a); own > partner(a).sureness)
        partner(a) = {kept, own, false};
      else if (partner(a).group == gone || partner(a).group == kept)
        partner(a).is_stale = true;
    }
  }

  Eigen::MatrixXf pairs_;         // of groups
  Eigen::VectorXf areas_;         // of groups
  std::vector<Partner> partner_;  // of each group
  std::vector<std::vector<Index>> members_;
  std::vector<std::size_t> node_;  // of each group in the tree
  std::vector<Index> alive_;       // groups, ascending
  GroupTree tree_;
};

// Each flip lowers the energy, so that they end; no scan needed more than 20.
constexpr int kMostFlips = 200;
// A smaller gain, beside the area of all pieces, is rounding.
constexpr float kLeastGain = 1e-6F;

/// The group whose flip lowers the energy most: the number of a piece, or of a join plus that of
/// pieces. What a group gains is its coupling to all others.
struct BestFlip {
  std::size_t group = 0;
  float gain = 0.0F;
};

BestFlip find_best_flip(const SideEnergy& energy, const GroupTree& tree) {
  const Eigen::VectorXf& sides = tree.sides;
  const Eigen::VectorXf coupling = sides.cwiseProduct(energy.pairs * sides);
  const auto count = static_cast<std::size_t>(sides.size());
  std::vector<float> to_all(count + tree.joins.size());  // of a group's pieces to all pieces
  std::vector<float> within(to_all.size(), 0.0F);
  BestFlip best;
  for (std::size_t group = 0; group < to_all.size(); ++group) {
    if (group < count) {
      to_all[group] = coupling[static_cast<Index>(group)];
    } else {
      const GroupTree::Join& join = tree.joins[group - count];
      float across = 0.0F;
      for (const Index a : join.first) {
        float sum = 0.0F;
        for (const Index b : join.second) sum += energy.pairs(b, a) * sides[b];
        across += sides[a] * sum;
      }
      to_all[group] = to_all[join.parts[0]] + to_all[join.parts[1]];
      within[group] = within[join.parts[0]] + within[join.parts[1]] + 2.0F * across;
    }
    const float gain = within[group] - to_all[group];
    if (gain > best.gain) best = {group, gain};
  }
  return best;
}

void flip(std::size_t group, GroupTree& tree) {
  const auto count = static_cast<std::size_t>(tree.sides.size());
  if (group < count) {
    tree.sides[static_cast<Index>(group)] *= -1.0F;
    return;
  }
  const GroupTree::Join& join = tree.joins[group - count];
  for (const Index a : join.first) tree.sides[a] *= -1.0F;
  for (const Index a : join.second) tree.sides[a] *= -1.0F;
}

}  // namespace

float energy_of(const SideEnergy& energy, const Eigen::VectorXf& sides) {
  return -energy.fields.dot(sides) - 0.5F * sides.dot(energy.pairs * sides);
}

Eigen::VectorXf choose_sides(const SideEnergy& energy) {
  const Index count = energy.fields.size();
  const SideEnergy all = with_outside(energy);
  GroupTree tree = Contraction(all).run();
  const float least = kLeastGain * energy.areas.sum();
  for (int flips = 0; flips < kMostFlips; ++flips) {
    const BestFlip best = find_best_flip(all, tree);
    if (!(best.gain > least)) break;
    flip(best.group, tree);
  }
  return tree.sides.head(count) * tree.sides[count];
}

}  // namespace relief

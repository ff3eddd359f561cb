#include "preprocess/tiles/join_sheets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>
#include <tuple>
#include <unordered_map>

#include "preprocess/normals/signed_forest.h"
#include "preprocess/tiles/checkpoint.h"
#include "preprocess/tiles/survey.h"

namespace relief {
namespace {

/// Two sheets of different tiles, by global number, and the number of common points that agree
/// minus those that do not.
struct Link {
  std::uint32_t a;
  std::uint32_t b;
  std::int64_t votes;
};

// A sheet's side was found from all of its points. Points common with another tile turn it only if
// they are as many as a strip along its whole side, a halo wide, or as half of it: a body of
// 437,000 points near a border, in whose halo some points of its ground lay, was turned by these.
constexpr double kStripWidth = 12.0;  // points
constexpr double kTurningShare = 0.5;

class Joiner {
 public:
  explicit Joiner(const std::vector<SurveyPaths>& tiles) : tiles_(tiles) {}

  Result<SheetTurns> run(const Progress& progress) {
    for (const auto step : {&Joiner::number_sheets, &Joiner::count_votes}) {
      RELIEF_TRY((this->*step)(progress));
    }
    return decide();
  }

 private:
  /// Global sheet 0 stands for given normals, which need no flip.
  Status number_sheets(const Progress& progress) {
    sums_.emplace_back();
    for (const SurveyPaths& tile : tiles_) {
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY_ASSIGN(const auto survey, load_survey(tile.survey));
      first_.push_back(static_cast<std::uint32_t>(sums_.size()));
      count_.push_back(survey.sheets.count);
      has_surface_.push_back(survey.region_normals.empty() ? 0 : 1);
      sums_.insert(sums_.end(), survey.sums.begin(), survey.sums.end());
      std::vector<RimPoint> rim;
      RELIEF_TRY(load_checkpoint(tile.rim, std::tie(rim)));
      homes_.emplace_back();
      for (const RimPoint& point : rim) {
        if (homes_.back().empty() || homes_.back().back() != point.home.tile)
          homes_.back().push_back(point.home.tile);
      }
    }
    return {};
  }

  [[nodiscard]] std::uint32_t number_of(std::size_t tile, std::uint32_t sheet) const {
    return count_[tile] > 0 ? first_[tile] + sheet : 0;
  }

  /// Home by home, so that at most two tiles' files are in memory.
  Status count_votes(const Progress& progress) {
    const bool all_are_given = sums_.size() == 1;
    if (all_are_given) return {};
    for (std::uint32_t home = 0; home < tiles_.size(); ++home) {
      if (has_surface_[home] == 0) continue;
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY_ASSIGN(const auto survey, load_survey(tiles_[home].survey));
      for (std::size_t other = 0; other < tiles_.size(); ++other) {
        const bool may_disagree = count_[home] > 0 || count_[other] > 0;
        if (!may_disagree || has_surface_[other] == 0) continue;
        if (std::find(homes_[other].begin(), homes_[other].end(), home) == homes_[other].end())
          continue;
        RELIEF_TRY(count_votes_between(home, survey, other));
      }
    }
    return {};
  }

  Status count_votes_between(std::uint32_t home, const TileSurvey& survey, std::size_t other) {
    std::vector<RimPoint> rim;
    RELIEF_TRY(load_checkpoint(tiles_[other].rim, std::tie(rim)));
    const auto is_before = [](const RimPoint& point, std::uint32_t tile) {
      return point.home.tile < tile;
    };
    auto seen = std::lower_bound(rim.begin(), rim.end(), home, is_before);
    for (; seen != rim.end() && seen->home.tile == home; ++seen) {
      const std::uint32_t i =
          survey.number.empty() ? seen->home.point : survey.number[seen->home.point];
      const std::uint32_t a = number_of(home, count_[home] > 0 ? survey.sheets.of_point[i] : 0);
      const std::uint32_t b = number_of(other, seen->sheet);
      const std::uint64_t pair = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
      votes_[pair] += glm::dot(survey.normals[i], seen->normal) < 0.0F ? -1 : 1;
    }
    return {};
  }

  /// Whether a link would turn a sheet for too few points.
  [[nodiscard]] bool is_weak(const Link& link) const {
    const bool is_of_given = link.a == 0;
    if (link.votes >= 0 || is_of_given) return false;
    const double points = std::min(sums_[link.a].points, sums_[link.b].points);
    return static_cast<double>(-link.votes) <
           std::min(kStripWidth * std::sqrt(points), kTurningShare * points);
  }

  SheetTurns decide() {
    std::vector<Link> links;
    links.reserve(votes_.size());
    for (const auto& [pair, votes] : votes_) {
      const Link link{static_cast<std::uint32_t>(pair >> 32U), static_cast<std::uint32_t>(pair),
                      votes};
      if (!is_weak(link)) links.push_back(link);
    }
    std::sort(links.begin(), links.end(), [](const Link& x, const Link& y) {
      return std::tuple(-std::abs(x.votes), x.a, x.b) < std::tuple(-std::abs(y.votes), y.a, y.b);
    });
    SignedForest forest(sums_.size());
    for (const Link& link : links) {
      const SignedForest::Root a = forest.find(link.a);
      const SignedForest::Root b = forest.find(link.b);
      if (a.root != b.root) forest.join(a, b, link.votes < 0);
    }

    std::vector<SheetSums> joined(sums_.size());
    for (std::uint32_t s = 0; s < sums_.size(); ++s) {
      const SignedForest::Root root = forest.find(s);
      joined[root.root].add(sums_[s], root.flipped);
    }
    const SignedForest::Root given = forest.find(0);
    SheetTurns turns(tiles_.size());
    for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
      for (std::uint32_t sheet = 0; sheet < count_[tile]; ++sheet) {
        const SignedForest::Root root = forest.find(first_[tile] + sheet);
        const bool root_is_turned =
            root.root == given.root ? given.flipped : faces_inward(joined[root.root]);
        turns[tile].push_back(root.flipped != root_is_turned ? 1 : 0);
      }
    }
    return turns;
  }

  const std::vector<SurveyPaths>& tiles_;
  std::vector<SheetSums> sums_;                    // of all sheets
  std::vector<std::uint32_t> first_;               // of each tile's sheets
  std::vector<std::uint32_t> count_;               // of each tile's sheets; 0: normals are given
  std::vector<std::uint8_t> has_surface_;          // tiles without sums do not count
  std::vector<std::vector<std::uint32_t>> homes_;  // of the points in each tile's rim
  std::unordered_map<std::uint64_t, std::int64_t> votes_;
};

/// No sheet of any tile turns.
Result<SheetTurns> turn_none(const std::vector<SurveyPaths>& tiles, const Progress& progress) {
  SheetTurns turns;
  for (const SurveyPaths& tile : tiles) {
    if (progress.cancelled()) return interrupted_error();
    RELIEF_TRY_ASSIGN(const auto survey, load_survey(tile.survey));
    turns.emplace_back(survey.sheets.count, std::uint8_t{0});
  }
  return turns;
}

}  // namespace

Result<SheetTurns> join_sheets(const std::vector<SurveyPaths>& tiles, bool are_sure,
                               const Progress& progress) {
  return are_sure ? turn_none(tiles, progress) : Joiner(tiles).run(progress);
}

}  // namespace relief

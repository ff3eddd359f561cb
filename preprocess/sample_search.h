// Looks for the fewest samples that reach an error.
#pragma once

#include <optional>

namespace relief {

/// Samples a point at which a search gives up: half the distance between points, which tell no
/// finer.
inline constexpr double kFinestSamplesPerPoint = 4.0;

/// A search by trials. Errors of smooth surfaces fall as samples grow in number: cells of side h
/// are off by about h^2, and there are 1 / h^2 of them.
class SampleSearch {
 public:
  /// `error`: to be reached, above 0, in the unit of what is noted; `points`: of the scan.
  SampleSearch(double error, double points);

  /// How many samples to try next; nothing once the search has ended. It ends within 5 % of the
  /// error, where more samples are of no use or fewer are not to be had, and after 8 trials.
  [[nodiscard]] std::optional<double> next() const;

  /// Notes what asking for that many samples gave. Returns whether it is the best trial so far: the
  /// fewest samples that reach the error, or else the smallest error.
  bool note(double asked, double made, double error);

 private:
  struct Trial {
    double samples = 0.0;  ///< asked for
    double made = 0.0;
    double error = 0.0;
  };
  double wanted_;
  double points_;
  int trials_ = 0;
  std::optional<Trial> enough_;   ///< the fewest that reach the error
  std::optional<Trial> too_few_;  ///< the most that do not
  double least_error_;            ///< of those that do not
  bool fell_short_ = false;       ///< the last trial was between those two, and too few
  bool is_fewest_ = false;        ///< asking for fewer gave as many: each patch has some
};

}  // namespace relief

// What the scalars of a scan larger than memory are like.
#pragma once

#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "common/points.h"
#include "common/scalar.h"
#include "preprocess/points/chance_sample.h"

namespace relief {

/// Describes scalars whose values come block by block. Memory stays small: quantiles of more than
/// kValues values are those of a sample.
class ScalarSurvey {
 public:
  static constexpr std::size_t kValues = std::size_t{1} << 15U;

  /// Takes the scalars of the next points. Values are finite or NaN.
  void take(const Points& block);

  /// Describes the scalars that all blocks have, but for those without any value.
  [[nodiscard]] std::vector<ScalarInfo> describe();

  /// The scalars that some blocks have and others lack, ascending.
  [[nodiscard]] const std::set<std::string>& left_out() const { return left_out_; }

 private:
  struct Column {
    std::string name;
    double low = 0.0;
    double high = 0.0;
    bool has_values = false;
    bool are_whole = true;
    bool are_labels = true;
    ChanceSample<double, kValues> sample = {};

    void add(double value);
  };

  std::vector<Column> columns_;
  std::set<std::string> left_out_;
  bool is_first_ = true;
};

/// Gives points just these of their scalars, in this order, as labels where they are such.
void keep_scalars(std::span<const ScalarInfo> kept, Points& points);

}  // namespace relief

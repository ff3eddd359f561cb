#include "preprocess/sample_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief {
namespace {

constexpr int kMostTrials = 8;
/// Errors from this share of what is wanted on are near enough, and what is aimed at.
constexpr double kNearEnough = 0.95;
/// Largest change of the number of samples from trial to trial.
constexpr double kLongestStep = 4.0;
// Of the samples before. Ragged scans at coarse spacings are mostly margins, and slow.
constexpr double kFewerSamples = 0.8;
constexpr double kFewestSamples = 64.0;

}  // namespace

SampleSearch::SampleSearch(double error, double points)
    : wanted_(error), points_(points), least_error_(std::numeric_limits<double>::infinity()) {}

std::optional<double> SampleSearch::next() const {
  const double most = std::max(kFinestSamplesPerPoint * points_, kFewestSamples);
  const double aim = (0.5 + 0.5 * kNearEnough) * wanted_;
  if (trials_ == 0) return std::max(points_, kFewestSamples);
  if (trials_ >= kMostTrials || is_fewest_) return std::nullopt;
  if (enough_ && enough_->error >= kNearEnough * wanted_) return std::nullopt;
  if (enough_ && too_few_) {
    // As a power of the number between both.
    const double length = std::log(enough_->samples / too_few_->samples);
    const double fall = std::log(too_few_->error / std::max(enough_->error, 1e-300));
    if (length < 0.05) return std::nullopt;
    // Where the last such step fell short, errors do not fall evenly.
    const double shortest = fell_short_ ? 0.25 : 0.1;
    const double share = std::clamp(std::log(too_few_->error / aim) / fall, shortest, 0.9);
    return too_few_->samples * std::exp(share * length);
  }
  if (enough_) {
    if (enough_->samples <= kFewestSamples) return std::nullopt;
    const double fewer = std::max(enough_->error / aim, 1.0 / kLongestStep);
    return std::max(enough_->samples * fewer, kFewestSamples);
  }
  if (too_few_->samples >= most) return std::nullopt;
  return std::min(too_few_->samples * std::min(too_few_->error / aim, kLongestStep), most);
}

bool SampleSearch::note(double asked, double made, double error) {
  ++trials_;
  const Trial trial{asked, made, error};
  fell_short_ = enough_ && too_few_ && error > wanted_;
  if (error <= wanted_) {
    is_fewest_ = !too_few_ && enough_ && made > kFewerSamples * enough_->made;
    const bool is_best = !enough_ || made < enough_->made;
    if (is_best) enough_ = trial;
    return is_best;
  }
  if (!too_few_ || asked > too_few_->samples) too_few_ = trial;
  const bool is_best = !enough_ && error < least_error_;
  least_error_ = std::min(least_error_, error);
  return is_best;
}

}  // namespace relief

#include "preprocess/resample/spacing/error_spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace relief {
namespace {

constexpr double kErrorInSpacings = 0.05;
// Limits of a patch's spacing over the model's at the fewest samples. A flat patch gains nothing by
// being still coarser once its border is most of it, and neighbours must still meet.
constexpr double kFinest = 0.5;
constexpr double kCoarsest = 1.25;
// Rows of samples across a narrow face. Errors (rms) of fandisk with 1,900 samples and of anchor
// with 1,500: 0.0075 and 0.0031 without, 0.0048 and 0.0019 with 2 rows, 0.0065 and 0.0021 with 3.
constexpr double kRowsAcross = 2.0;
// The share of all samples that narrow faces may have.
constexpr double kMostForNarrow = 0.5;

/// What a region asks for. World units.
struct Demand {
  double area = 0.0;
  double bend = 0.0;    ///< distance from a plane over the squared distance of the points
  double finest = 0.0;  ///< half the distance between its points: they tell no more
  double widest = std::numeric_limits<double>::infinity();  ///< spacing with two rows of samples
};

Demand demand_of(const SurfaceSamples& samples, const Region& region,
                 const std::vector<std::uint8_t>& at_crease) {
  Demand demand;
  double squares = 0.0;
  for (const std::uint32_t i : region.points) {
    const double area = double{samples.spacing[i]} * samples.spacing[i];
    if (!(area > 0.0)) continue;
    demand.area += area;
    if (at_crease[i] == 0) squares += double{samples.roughness[i]} * samples.roughness[i] / area;
  }
  if (!(demand.area > 0.0)) return demand;
  demand.bend = std::sqrt(squares / demand.area);
  demand.finest = 0.5 * std::sqrt(demand.area / static_cast<double>(region.points.size()));
  return demand;
}

/// Asks for rows of samples across narrow faces, fewer if they would have too many samples.
void see_to_widths(std::span<const double> widths, double usual, double fewest,
                   std::vector<Demand>& demands) {
  double samples = 0.0;
  for (std::size_t r = 0; r < widths.size(); ++r) {
    Demand& demand = demands[r];
    demand.widest = widths[r] / kRowsAcross;
    const double spacing = std::max(demand.widest, demand.finest);
    if (spacing < kCoarsest * usual) samples += demand.area / (spacing * spacing);
  }
  const double share = samples / (kMostForNarrow * fewest);
  if (!(share > 1.0)) return;
  for (Demand& demand : demands) demand.widest *= std::sqrt(share);
}

/// The spacings that share out samples at one price.
class Shares {
 public:
  /// `usual`: the spacing with the fewest samples if all patches have the same.
  Shares(std::vector<Demand> demands, double area, double usual)
      : demands_(std::move(demands)), area_(area), usual_(usual) {}

  [[nodiscard]] double spacing(const Demand& demand, double price) const {
    const double coarsest = kCoarsest * usual_;
    const double finest = std::max(kFinest * usual_, std::min(demand.finest, usual_));
    const double for_width = std::max(demand.widest, demand.finest);
    if (!(demand.bend > 0.0)) return std::min(coarsest, for_width);
    const double for_bend =
        std::clamp(price * std::cbrt(usual_ * usual_ / demand.bend), finest, coarsest);
    return std::min(for_bend, for_width);
  }
  [[nodiscard]] double samples(double price) const {
    double sum = 0.0;
    for (const Demand& d : demands_) sum += d.area / std::pow(spacing(d, price), 2.0);
    return sum;
  }
  /// In spacings of the model, rms.
  [[nodiscard]] double error(double price) const {
    double squares = 0.0;
    for (const Demand& d : demands_)
      squares += d.area * std::pow(d.bend * std::pow(spacing(d, price), 2.0), 2.0);
    return std::sqrt(squares / area_) / usual_;
  }
  [[nodiscard]] const std::vector<Demand>& demands() const { return demands_; }

 private:
  std::vector<Demand> demands_;
  double area_;
  double usual_;
};

/// The nearest of 8 steps an octave: patches with few different spacings have fewer bytes, 2 % of
/// the Dragon's with the codec compact.
double rounded(double factor) {
  return std::exp2(std::round(8.0 * std::log2(factor)) / 8.0);
}

/// The highest price that `is_too_high` allows.
template <class IsTooHigh>
double find_price(const IsTooHigh& is_too_high) {
  double low = 1e-6;
  double high = 1e6;
  // Halving the exponent forty times leaves a millionth of it.
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(low * high);
    (is_too_high(middle) ? high : low) = middle;
  }
  return low;
}

}  // namespace

SampleBudget share_samples(const SurfaceSamples& samples, const std::vector<Region>& regions,
                           const std::vector<std::uint8_t>& at_crease, SampleRange range,
                           std::span<const double> widths) {
  SampleBudget budget{std::vector<double>(regions.size(), 1.0), range.fewest};
  std::vector<Demand> demands;
  double area = 0.0;
  for (const Region& region : regions) {
    demands.push_back(demand_of(samples, region, at_crease));
    area += demands.back().area;
  }
  if (!(area > 0.0)) return budget;
  const double usual = std::sqrt(area / range.fewest);
  see_to_widths(widths, usual, range.fewest, demands);
  const Shares shares(std::move(demands), area, usual);

  double price = find_price([&](double p) { return shares.samples(p) < range.fewest; });
  if (shares.error(price) > kErrorInSpacings) {
    const double exact = find_price([&](double p) { return shares.error(p) > kErrorInSpacings; });
    const double dearest = find_price([&](double p) { return shares.samples(p) < range.most; });
    price = std::max(exact, dearest);
  }
  budget.samples = shares.samples(price);
  for (std::size_t r = 0; r < regions.size(); ++r)
    budget.factors[r] = rounded(shares.spacing(shares.demands()[r], price) / usual);
  return budget;
}

}  // namespace relief

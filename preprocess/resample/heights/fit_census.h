// How the fits of a conversion went.
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

namespace relief {

struct FitSummary {
  std::uint64_t fits = 0;
  std::uint64_t replaced = 0;  ///< of them, by tangent planes (MlsPoint::is_replaced)
  double condition = 1.0;      ///< the largest (MlsPoint::condition)

  FitSummary& operator+=(const FitSummary& more) {
    fits += more.fits;
    replaced += more.replaced;
    condition = std::max(condition, more.condition);
    return *this;
  }
};

/// Sums up what threads report of their fits.
class FitCensus {
 public:
  void add(const FitSummary& some) {
    const std::lock_guard lock(mutex_);
    sum_ += some;
  }
  /// Once all threads have reported.
  [[nodiscard]] const FitSummary& sum() const { return sum_; }

 private:
  std::mutex mutex_;
  FitSummary sum_;
};

}  // namespace relief

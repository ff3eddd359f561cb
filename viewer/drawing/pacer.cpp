#include "viewer/drawing/pacer.h"

#include <algorithm>

namespace relief {
namespace {

/// Frames that must be quick before a finer picture is tried; doubled each time that was too slow.
constexpr int kQuickFrames = 8;
constexpr int kMostDoublings = 5;

/// Frames over the target, as shares of it. A few that are a little late are the machine's own
/// doing.
constexpr double kSlow = 1.15;
constexpr double kVerySlow = 2.0;
constexpr int kSlowFrames = 3;

/// What a picture at another step takes, over this one: half of it depends on pixels. (The Dragon
/// at scale 0.3, 0.5, 0.84 on llvmpipe: 17, 21, 31 ms.)
double cost_ratio(std::size_t from, std::size_t to) {
  const double scale = kQualities[to].scale / kQualities[from].scale;
  return 0.5 + 0.5 * scale * scale;
}

}  // namespace

void Pacer::note_still(double ms) {
  if (!is_guess_) return;
  step_ = 0;
  while (step_ + 1 < kQualities.size() && ms * cost_ratio(0, step_) > target_ms_) ++step_;
}

void Pacer::note(double frame_ms) {
  is_guess_ = false;
  if (frame_ms > kSlow * target_ms_) {
    if (frame_ms < kVerySlow * target_ms_ && ++slow_frames_ < kSlowFrames) return;
    slow_frames_ = 0;
    const std::size_t before = step_;
    while (step_ + 1 < kQualities.size() &&
           (step_ == before || frame_ms * cost_ratio(before, step_) > target_ms_))
      ++step_;
    if (quick_frames_ < 0) slow_after_finer_ = std::min(slow_after_finer_ + 1, kMostDoublings);
    quick_frames_ = 0;
    return;
  }
  slow_frames_ = 0;
  if (quick_frames_ < 0) {  // the finer step is quick enough
    if (++quick_frames_ == 0) slow_after_finer_ = 0;
    return;
  }
  const bool would_fit = step_ > 0 && frame_ms * cost_ratio(step_, step_ - 1) < 0.95 * target_ms_;
  quick_frames_ = would_fit ? quick_frames_ + 1 : 0;
  if (quick_frames_ < kQuickFrames << slow_after_finer_) return;
  --step_;
  quick_frames_ = -kQuickFrames;
}

}  // namespace relief

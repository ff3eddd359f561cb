// The quality of moving pictures, against machines of known speed.
#include "viewer/drawing/pacer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace relief {
namespace {

/// A machine whose frames take so long at full quality, of which a part does not depend on pixels.
struct Machine {
  double full_ms = 100.0;
  double fixed_ms = 5.0;
  [[nodiscard]] double frame(const Quality& quality) const {
    return fixed_ms + (full_ms - fixed_ms) * quality.scale * quality.scale;
  }
};

std::vector<double> run(Pacer& pacer, const Machine& machine, int frames) {
  std::vector<double> times;
  for (int k = 0; k < frames; ++k) {
    times.push_back(machine.frame(pacer.quality()));
    pacer.note(times.back());
  }
  return times;
}

TEST(Pacer, KeepsTheTargetOnMachinesOfAllSpeeds) {
  for (const double full_ms : {2.0, 20.0, 50.0, 100.0, 200.0, 300.0}) {
    const Machine machine{full_ms, 3.0};
    Pacer pacer(33.0);
    run(pacer, machine, 100);
    const std::vector<double> times = run(pacer, machine, 400);
    // A finer step is tried now and then, and given up after one frame.
    const auto late = std::count_if(times.begin(), times.end(), [](double t) { return t > 40.0; });
    EXPECT_LE(late, 12) << full_ms;
    EXPECT_GT(*std::min_element(times.begin(), times.end()), 0.0);
  }
}

TEST(Pacer, GuessesByThePictureAtRestUntilItHasMoved) {
  Pacer slow(33.0);
  slow.note_still(250.0);
  EXPECT_EQ(slow.quality().scale, kQualities.back().scale);
  Pacer fast(33.0);
  fast.note_still(5.0);
  EXPECT_EQ(fast.quality().scale, 1.0);
  fast.note(40.0);
  const double known = fast.quality().scale;
  fast.note_still(1000.0);
  EXPECT_EQ(fast.quality().scale, known);
  fast.forget();
  fast.note_still(1000.0);
  EXPECT_EQ(fast.quality().scale, kQualities.back().scale);
}

TEST(Pacer, IsAsFineAsTheMachineAllows) {
  Pacer fast(33.0);
  run(fast, {20.0, 3.0}, 100);
  EXPECT_EQ(fast.quality().scale, 1.0);
  Pacer slow(33.0);
  const Machine machine{100.0, 5.0};
  run(slow, machine, 100);
  // One step finer would take longer than the target.
  EXPECT_LE(machine.frame(slow.quality()), 38.0);
  EXPECT_GT(machine.frame({slow.quality().scale / 0.84, 4.0}), 31.0);
}

TEST(Pacer, GetsOutOfASlowSceneInOneFrame) {
  Pacer pacer(33.0);
  run(pacer, {20.0, 3.0}, 100);
  pacer.note(200.0);
  EXPECT_LE(pacer.quality().scale, 0.5);
}

TEST(Pacer, ATargetThatNothingReachesEndsAtTheCoarsest) {
  Pacer pacer(5.0);
  run(pacer, {1000.0, 900.0}, 50);
  EXPECT_EQ(pacer.quality().scale, kQualities.back().scale);
}

}  // namespace
}  // namespace relief

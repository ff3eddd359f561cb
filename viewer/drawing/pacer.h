// How coarse a picture is while the camera moves.
#pragma once

#include <array>
#include <cstddef>

namespace relief {

/// A quality of moving pictures.
struct Quality {
  double scale = 1.0;              ///< the picture's sides over the window's
  double pixels_per_sample = 4.0;  ///< RenderSettings::pixels_per_sample
  double afar_factor = 1.0;        ///< RenderSettings::afar_factor
};

/// From the finest, which is that of pictures at rest but for antialiasing. Each step has fewer
/// pixels than the one before, and coarser levels of detail. The first two draw patches. Beyond
/// that a machine has no GPU: what takes its time are vertices, most of all those of seams, which
/// the meshes that stand for models seen from afar have not. (The Dragon, 384x240, llvmpipe: 33 ms
/// a frame; from afar 10 ms.)
inline constexpr std::array<Quality, 7> kQualities{{{1.0, 4.0, 1.0},
                                                    {0.84, 6.0, 1.0},
                                                    {0.84, 8.0, 4.0},
                                                    {0.7, 8.0, 4.0},
                                                    {0.5, 10.0, 4.0},
                                                    {0.4, 12.0, 4.0},
                                                    {0.3, 16.0, 4.0}}};

/// Chooses the quality at which a frame takes about a target time.
class Pacer {
 public:
  explicit Pacer(double target_ms) : target_ms_(target_ms) {}

  [[nodiscard]] const Quality& quality() const { return kQualities[step_]; }

  /// What the frame that was drawn at quality() took. One that took far too long, or some that took
  /// too long, make the next coarser by as many steps as the pixels suggest; several that took
  /// little make it finer by one.
  void note(double frame_ms);

  /// What a whole picture at rest took, of the finest quality: a guess, until note() knows better.
  void note_still(double ms);

  /// Another model is shown.
  void forget() { is_guess_ = true; }

  void set_target(double target_ms) { target_ms_ = target_ms; }
  [[nodiscard]] double target_ms() const { return target_ms_; }

 private:
  double target_ms_;
  /// The coarsest: the first picture is to be there at once.
  std::size_t step_ = kQualities.size() - 1;
  bool is_guess_ = true;  ///< of step_: nothing has moved yet
  int slow_frames_ = 0;   ///< one after the other
  int quick_frames_ = 0;  ///< one after the other
  int slow_after_finer_ =
      0;  ///< how often a finer step was too slow, which is then tried less often
};

}  // namespace relief

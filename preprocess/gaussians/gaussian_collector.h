// Collects the Gaussians of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/volume/gaussian_cloud.h"
#include "preprocess/gaussians/axis_signs.h"
#include "preprocess/readers/source.h"

namespace relief {

/// A Gaussian as its file has it, without its harmonics.
struct FileGaussian {
  glm::dvec3 centre;
  glm::dvec3 log_scales;  ///< natural logarithms
  glm::dquat rotation;    ///< of any length
  double opacity = 0.0;
};

/// Takes the Gaussians of a file, which different threads may set at the same time.
class GaussianCollector {
 public:
  /// `count` is checked against the bytes of the file.
  GaussianCollector(std::size_t count, int degree, AxisSigns axes);

  /// The coefficients of a Gaussian, to be filled before `set`.
  [[nodiscard]] std::span<glm::vec3> harmonics(std::size_t index) {
    return std::span(cloud_.harmonics).subspan(index * stride_, stride_);
  }
  /// Sets a Gaussian and turns it into the frame of GaussianCloud, with its harmonics.
  void set(std::size_t index, const FileGaussian& gaussian);

  /// Returns what was set, without Gaussians that can't be drawn, which one note counts. Fails if
  /// none is left.
  Result<GaussianCloud> finish(const Source& source) &&;

 private:
  void drop();

  GaussianCloud cloud_;
  std::size_t stride_;  ///< coefficients of a Gaussian
  AxisSigns axes_;
  HarmonicsSigns harmonics_signs_;
  std::vector<std::uint8_t> is_bad_;
};

}  // namespace relief

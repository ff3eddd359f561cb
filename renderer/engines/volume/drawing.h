// A way to draw kernels: lists of splats a tile, blended quads, or rays through a grid's sheets.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/engines/volume/image.h"
#include "renderer/gl/drawing/pass.h"
#include "renderer/gl/functions.h"
#include "renderer/settings.h"
#include "renderer/view/view.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume {

/// The nodes that have kernels, both ends included.
struct NodeBox {
  glm::uvec3 low{0};
  glm::uvec3 high{0};

  [[nodiscard]] glm::uvec3 size() const { return high - low + 1U; }
};

/// One frame of a cloud of kernels.
struct VolumeFrame {
  const KernelCloud& cloud;
  std::uint64_t cloud_version = 0;  ///< another one when the cloud has changed
  NodeBox box;                      ///< of a grid that is not empty
  /// Of each kernel, as it is blended. Empty where GridDrawing::lights_nodes().
  std::span<const glm::vec3> colours;
  KernelColour colour;  ///< of CpuDrawing's frames, in place of `colours`
  const Lighting* distant_lights =
      nullptr;  ///< of CpuDrawing's: what `colour` asks, if nothing else
  const View& view;
  const RenderSettings& settings;
  std::span<const FootprintRule> footprints;  ///< of each part of the cloud
  double spacing = 0.0;  ///< mean distance of a volume's nodes, world units; 0: no volume
  Features features;     ///< RELIEF_FEATURE bits of the outputs
  /// Where opaque surfaces end what pixels show, as DepthLimits'; empty: nowhere. For shaders
  /// texture RELIEF_VOLUME_TEXTURE_LIMITS is bound, too.
  std::span<const float> limits;
};

class VolumeDrawing {
 public:
  VolumeDrawing() = default;
  virtual ~VolumeDrawing() = default;
  VolumeDrawing(const VolumeDrawing&) = delete;
  VolumeDrawing& operator=(const VolumeDrawing&) = delete;

  /// Draws into targets that are cleared. Fails if a shader or the memory does.
  virtual Status draw(const VolumeFrame& frame, const VolumeTargets& targets, PassTimer& timer,
                      const Progress& progress) = 0;
};

}  // namespace relief::volume

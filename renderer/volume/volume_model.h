// A volume or a scene of Gaussians as kernels, kept from image to image.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/bounds.h"
#include "common/error.h"
#include "common/progress.h"
#include "common/volume/clip_box.h"
#include "common/volume/spacing.h"
#include "renderer/model.h"
#include "renderer/settings.h"
#include "renderer/shading/environment_cache.h"
#include "renderer/view/view.h"
#include "renderer/volume/kernel_cloud.h"

namespace relief {

/// Borrows a volume or a scene of Gaussians, and makes its kernels when they are first needed, and
/// again when their settings change.
class VolumeModel {
 public:
  /// Of a model that has one of the two.
  explicit VolumeModel(const RenderModel& model)
      : volume_(model.find<ScalarVolume>()), gaussians_(model.find<GaussianCloud>()) {
    assert((volume_ != nullptr || gaussians_ != nullptr) &&
           "there is a volume, or there are Gaussians");
  }

  /// The kernels for these settings. Fails if the transfer function can't be read, or if the clip
  /// box holds nothing of the model.
  Result<const KernelCloud*> kernels(const RenderSettings& settings, const Progress& progress);

  /// Their colours as an image with these settings blends them: Gaussians' seen from the eye, a
  /// volume's lit at the nodes (pre-shaded).
  Result<std::vector<glm::vec3>> colours(const KernelCloud& kernels, const RenderSettings& settings,
                                         const View& view, EnvironmentCache& environments) const;

  /// The clip box in world coordinates; none if there is none. Fails if it holds nothing.
  [[nodiscard]] Result<std::optional<Bounds>> clip_box(const RenderSettings& settings) const;

  /// How often the kernels have been made.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  [[nodiscard]] const ScalarVolume* volume() const { return volume_; }
  /// Mean distance of a volume's nodes, world units; 0 of Gaussians.
  [[nodiscard]] double spacing() const { return volume_ == nullptr ? 0.0 : mean_spacing(*volume_); }
  /// Whether colours are blended as encoded sRGB.
  [[nodiscard]] bool blends_encoded(const RenderSettings& settings) const {
    return gaussians_ != nullptr && settings.volume.gaussians.blend == GaussianBlend::Srgb;
  }
  [[nodiscard]] bool is_antialiased() const {
    return gaussians_ != nullptr && gaussians_->is_antialiased;
  }

 private:
  /// What the kernels of a volume depend on; those of Gaussians on the clip box alone.
  struct Key {
    std::string transfer;
    double sigma = 0.0;
    std::optional<double> iso;
    double iso_opacity = 0.0;
    std::optional<ClipBox> clip;
    int level = 0;  ///< of coarser kernels, whose weights depend on the attenuation
    Attenuation attenuation = Attenuation::Linear;
    bool operator==(const Key&) const = default;
  };

  [[nodiscard]] int level_for(const RenderSettings& settings) const;

  const ScalarVolume* volume_;
  const GaussianCloud* gaussians_;
  std::optional<Key> key_;
  KernelCloud kernels_;
  std::uint64_t version_ = 0;
};

/// Near plane of views: no part of a volume that can be told apart is nearer to the eye.
[[nodiscard]] View volume_view(const RenderSettings& settings);

/// A pixel's colour, blended as encoded sRGB and multiplied by its alpha, as linear light
/// multiplied by the same alpha.
[[nodiscard]] glm::dvec3 decoded(glm::dvec3 premultiplied, double alpha);

}  // namespace relief

// Volumes and scenes of Gaussians as kernels, kept from image to image.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/progress.h"
#include "common/volume/clip_box.h"
#include "common/volume/spacing.h"
#include "renderer/model.h"
#include "renderer/settings.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/shading/shading.h"
#include "renderer/view/view.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/splats/footprint.h"

namespace relief {

/// The colour of a kernel, by its index.
using KernelColour = std::function<glm::vec3(std::size_t)>;

/// Borrows volumes and scenes of Gaussians, and makes their kernels when they are first needed, and
/// again when their settings change.
class VolumeModel {
 public:
  /// Of a model that has a volume, Gaussians or several of them.
  explicit VolumeModel(const RenderModel& model);

  /// The settings of an image of this model: of a single volume its own as RenderSettings::volume.
  [[nodiscard]] RenderSettings settled(RenderSettings settings) const;

  /// The kernels for these settings. Fails if a transfer function can't be read, if the clip box
  /// holds nothing of the model, and if opacities of Gaussians are to be optical depths beside a
  /// volume's.
  Result<const KernelCloud*> kernels(const RenderSettings& settings, const Progress& progress);

  /// How the kernels of each part become footprints.
  [[nodiscard]] std::vector<FootprintRule> footprint_rules(const RenderSettings& settings,
                                                           const View& view) const;

  /// The colour of a kernel as an image with these settings blends it: a Gaussian's seen from the
  /// eye, a volume's lit at the node (pre-shaded). It borrows the kernels and the environments.
  Result<KernelColour> colour_of(const KernelCloud& kernels, const RenderSettings& settings,
                                 const View& view, EnvironmentCache& environments) const;

  /// What all kernels are lit by where that is Material::Lit and distant lights alone, as an image
  /// with these settings needs it; else none.
  Result<std::optional<Lighting>> distant_lights(const RenderSettings& settings, const View& view,
                                                 EnvironmentCache& environments) const;

  /// The colours of all.
  Result<std::vector<glm::vec3>> colours(const KernelCloud& kernels, const RenderSettings& settings,
                                         const View& view, EnvironmentCache& environments) const;

  /// The clip box in world coordinates; none if there is none. Fails if it holds nothing.
  [[nodiscard]] Result<std::optional<Bounds>> clip_box(const RenderSettings& settings) const;

  /// How often the kernels have been made.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// The volume, if it is the only thing that there is; else null.
  [[nodiscard]] const ScalarVolume* volume() const {
    return parts_.size() == 1 ? parts_.front().volume : nullptr;
  }
  /// Mean distance of nodes, world units, of the finest volume; 0 without a volume.
  [[nodiscard]] double spacing() const;
  /// Whether colours are blended as encoded sRGB. Beside a volume Gaussians are blended as linear
  /// light.
  [[nodiscard]] bool blends_encoded(const RenderSettings& settings) const {
    return !has_volume() && settings.volume.gaussians.blend == GaussianBlend::Srgb;
  }

 private:
  /// One of the two.
  struct Part {
    const ScalarVolume* volume = nullptr;
    const GaussianCloud* gaussians = nullptr;
    std::uint8_t material = 0;
    std::size_t settings = 0;
  };
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

  [[nodiscard]] bool has_volume() const;
  Result<KernelCloud> kernels_of(const Part& part, const VolumeSettings& chosen,
                                 const Progress& progress) const;
  Result<KernelColour> colour_of_part(const Part& part, const KernelCloud& kernels,
                                      std::size_t first, const RenderSettings& settings,
                                      const View& view, EnvironmentCache& environments) const;
  /// The level of a grid's nodes that a view of it needs: 0 is the finest.
  [[nodiscard]] int level_for(const RenderSettings& settings) const;

  std::vector<Part> parts_;
  std::optional<std::vector<Key>> keys_;
  KernelCloud kernels_;
  std::uint64_t version_ = 0;
};

/// The settings of an image in which a volume with a material of its own is lit. Of that material
/// only the kind is its own.
[[nodiscard]] RenderSettings with_own_material(RenderSettings settings,
                                               const VolumeSettings& volume);

/// Near plane of views: no part of a volume that can be told apart is nearer to the eye.
[[nodiscard]] View volume_view(const RenderSettings& settings);

/// A pixel's colour, blended as encoded sRGB and multiplied by its alpha, as linear light
/// multiplied by the same alpha.
[[nodiscard]] glm::dvec3 decoded(glm::dvec3 premultiplied, double alpha);

}  // namespace relief

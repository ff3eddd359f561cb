// What can be chosen about volumes and 3D Gaussians.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/scene/choices.h"
#include "common/volume/clip_box.h"

namespace relief {

/// What keeps kernels from being smaller than pixels [Zwicker 2002, section 6.2 and Figure 14].
enum class VolumeFilter : std::uint8_t {
  Automatic,       ///< Dilated for 3D Gaussians that were trained with it, else Ewa
  Ewa,             ///< convolved with a Gaussian, which keeps the integral
  UniformScaling,  ///< enlarged until the minor radius is that of the low-pass filter [Swan 1997]
  Unfiltered,
  Dilated  ///< widened by 0.3 pixels squared, the opacity at the centre unchanged [Kerbl 2023]
};

/// In which order kernels occlude one another.
enum class VolumeVisibility : std::uint8_t {
  Automatic,   ///< Sheet for grids, else Sorted
  Sheet,       ///< the grid's planes that are most parallel to the image [Westover 1990]
  ImageSheet,  ///< slabs parallel to the image, each with its slice of a kernel [Mueller 1998]
  Sorted       ///< one kernel after the other, by the depth of the centre
};

/// How an optical depth becomes an opacity.
enum class Attenuation : std::uint8_t {
  Linear,      ///< itself, at most 1: Eq. (10) of [Zwicker 2002]
  Exponential  ///< 1 - exp(-depth)
};

/// The colours that 3D Gaussians are blended in.
enum class GaussianBlend : std::uint8_t { Srgb, Linear };

/// What the engine `volume` draws kernels with.
enum class VolumeDrawingBy : std::uint8_t {
  Automatic,  ///< Cpu where OpenGL draws on the CPU, too
  Shaders,
  Cpu  ///< Shaders for slabs, normals and depths, and beside surfaces
};

inline constexpr std::array<Named<VolumeFilter>, 5> kVolumeFilters{
    {{"auto", VolumeFilter::Automatic},
     {"ewa", VolumeFilter::Ewa},
     {"uniform-scaling", VolumeFilter::UniformScaling},
     {"unfiltered", VolumeFilter::Unfiltered},
     {"dilated", VolumeFilter::Dilated}}};
inline constexpr std::array<Named<VolumeVisibility>, 4> kVolumeVisibilities{
    {{"auto", VolumeVisibility::Automatic},
     {"sheet", VolumeVisibility::Sheet},
     {"image-sheet", VolumeVisibility::ImageSheet},
     {"sorted", VolumeVisibility::Sorted}}};
inline constexpr std::array<Named<Attenuation>, 2> kAttenuations{
    {{"linear", Attenuation::Linear}, {"exponential", Attenuation::Exponential}}};
inline constexpr std::array<Named<GaussianBlend>, 2> kGaussianBlends{
    {{"srgb", GaussianBlend::Srgb}, {"linear", GaussianBlend::Linear}}};

inline constexpr std::array<Named<VolumeDrawingBy>, 3> kVolumeDrawingsBy{
    {{"auto", VolumeDrawingBy::Automatic},
     {"shaders", VolumeDrawingBy::Shaders},
     {"cpu", VolumeDrawingBy::Cpu}}};

inline constexpr NumberChoice kKernelSigmas{0.25, 4.0};
inline constexpr NumberChoice kShares{0.0, 1.0};
inline constexpr NumberChoice kPixelsPerNode{0.0, 4.0};

/// How 3D Gaussians are blended. The defaults are those of the program that trains them
/// [Kerbl 2023], so that a scene looks as its authors saw it.
struct GaussianSettings {
  double max_alpha = 0.99;
  double min_alpha = 1.0 / 255.0;   ///< fainter contributions are left out
  double min_transmittance = 1e-4;  ///< what is behind no longer counts
  double near = 0.2;                ///< world units; nearer centres are not drawn
  double jacobian_clamp = 1.3;      ///< the Jacobian is that of a place at most so many times as
                                    ///< far from the axis as the image's edge; 0: its own place
  int degree = kMaxDegree;          ///< of the spherical harmonics that count
  GaussianBlend blend = GaussianBlend::Srgb;

  static constexpr int kMaxDegree = 4;
};

struct VolumeSettings {
  VolumeFilter filter = VolumeFilter::Automatic;
  VolumeVisibility visibility = VolumeVisibility::Automatic;
  Attenuation attenuation = Attenuation::Linear;
  double kernel_sigma = 1.0;  ///< standard deviation of a kernel, in spacings
  /// A regular grid without a surface is drawn at its coarsest level whose nodes are seen at most
  /// so many pixels apart; 0: as it is.
  double pixels_per_node = 0.0;
  /// Kernels end where x^T Q x reaches it; 0: 4 for volumes, and for Gaussians where their alpha
  /// falls below min_alpha.
  double cutoff = 0.0;
  std::optional<double> iso;  ///< a value whose surface is drawn with flattened kernels, too
  double iso_opacity = 0.9;   ///< of that surface, seen from the front
  /// What transfer_function_for() takes (common/volume/transfer_function.h).
  std::string transfer = "auto";
  std::optional<Material> material;  ///< in place of the image's
  std::optional<ClipBox> clip;       ///< kernels whose centres lie outside are not drawn
  GaussianSettings gaussians;
  VolumeDrawingBy drawn_by = VolumeDrawingBy::Automatic;  ///< by engine `volume`
};

}  // namespace relief

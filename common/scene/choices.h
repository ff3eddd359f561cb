// The choices for an image, with the names that the command line and scene files use.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace relief {

enum class Primitive : std::uint8_t { Sprite, Quad, Cell };
enum class Interpolation : std::uint8_t { Direct, Corrected };
enum class Material : std::uint8_t {
  Unlit,
  Lit,
  Mirror,
  Glass,
  Split  ///< for demonstration: quarters of the image as in Figure 1(d) of [Ochotta 2008]
};

/// The faces that are not drawn. Auto: the back faces of models known to be closed. Safe: of those
/// among them whose patches meet, drawn as cells, where what is left out is hidden anyway.
enum class CullMode : std::uint8_t { Safe, Auto, Back, None };

/// The resampling filters that Figure 8 of [Zwicker 2001] compares.
enum class EwaFilter : std::uint8_t {
  Ewa,          ///< screen space, Eq. (7)
  SourceSpace,  ///< the same filter over the tangent plane, Eq. (8)
  Circular,     ///< circles as wide as the screen-space ellipse's major axis
  Unfiltered    ///< ellipses without the low-pass filter
};

/// The range of a numeric option, on the command line and in scene files.
struct NumberChoice {
  double min;
  double max;
};
inline constexpr NumberChoice kSampleCounts{1, 65536};   ///< samples a pixel
inline constexpr NumberChoice kRadiusFactors{1.0, 4.0};  ///< of multipass, 2 as in [Ochotta 2008]
inline constexpr NumberChoice kPixelsPerSample{0.0, 64.0};  ///< of onepass; 0: no levels
inline constexpr NumberChoice kCutoffs{0.1, 20.0};          ///< c of [Zwicker 2001], an exponent
inline constexpr NumberChoice kLayerCounts{1, 64};  ///< l of [Zwicker 2001], fragments a pixel
inline constexpr NumberChoice kCoverageThresholds{1e-6, 1.0};  ///< tau of [Zwicker 2001]
inline constexpr NumberChoice kTimeBudgets{1e-3, 1e9};         ///< milliseconds

inline constexpr NumberChoice kZooms{0.01, 1e4};      ///< how many times as large a model is shown
inline constexpr NumberChoice kEyeDomes{0.0, 100.0};  ///< strengths of eye-dome lighting
inline constexpr NumberChoice kExposures{-20.0, 20.0};  ///< stops

/// The outputs of an image, beside colour and coverage, which every image has. Nothing is
/// allocated, written or read back for an output that is off.
struct Outputs {
  bool normal = false;
  bool depth = false;
  bool uv = false;
  bool patch_id = false;
  bool clip = false;  ///< how the splat in front is clipped: ClipKind (renderer/clip/)
};

/// Whether an image has outputs beside colour and coverage.
[[nodiscard]] inline bool has_any(const Outputs& outputs) {
  return outputs.normal || outputs.depth || outputs.uv || outputs.patch_id || outputs.clip;
}

/// Turns on an output: normal, depth, uv, patch or clip; colour is always on. Returns false for any
/// other name.
[[nodiscard]] inline bool add_output(Outputs& outputs, std::string_view name) {
  if (name == "colour") return true;
  if (name == "normal") return outputs.normal = true;
  if (name == "depth") return outputs.depth = true;
  if (name == "uv") return outputs.uv = true;
  if (name == "patch") return outputs.patch_id = true;
  if (name == "clip") return outputs.clip = true;
  return false;
}

/// Pixels; each side 1 to kMaxRenderSide.
struct ImageSize {
  std::uint32_t width = 1280;
  std::uint32_t height = 1024;
};
inline constexpr std::uint32_t kMaxRenderSide = 32768;

/// Vertical fields of view, degrees: from a telescope's to where the distortion at an image's rim
/// makes it useless.
inline constexpr double kMinFieldOfView = 0.01;
inline constexpr double kMaxFieldOfView = 175.0;

/// Heights of orthographic images, world units: as wide a range as that of coordinates.
inline constexpr NumberChoice kOrthographicHeights{1e-12, 1e12};

/// The size of an orthographic image: a height (world units), or none to fit the whole model.
struct OrthographicSize {
  std::optional<double> height;
};

/// A value of an enumeration and its name.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

inline constexpr std::array<Named<EwaFilter>, 4> kFilters{{{"ewa", EwaFilter::Ewa},
                                                           {"source-space", EwaFilter::SourceSpace},
                                                           {"circular", EwaFilter::Circular},
                                                           {"unfiltered", EwaFilter::Unfiltered}}};
inline constexpr std::array<Named<Primitive>, 3> kPrimitives{
    {{"sprite", Primitive::Sprite}, {"quad", Primitive::Quad}, {"cell", Primitive::Cell}}};
inline constexpr std::array<Named<Interpolation>, 2> kInterpolations{
    {{"direct", Interpolation::Direct}, {"corrected", Interpolation::Corrected}}};
inline constexpr std::array<Named<CullMode>, 4> kCullModes{{{"safe", CullMode::Safe},
                                                            {"auto", CullMode::Auto},
                                                            {"back", CullMode::Back},
                                                            {"none", CullMode::None}}};
inline constexpr std::array<Named<Material>, 5> kMaterials{{{"unlit", Material::Unlit},
                                                            {"lit", Material::Lit},
                                                            {"mirror", Material::Mirror},
                                                            {"glass", Material::Glass},
                                                            {"split", Material::Split}}};

/// Returns the value of a name, if the table has it.
template <class T, std::size_t N>
[[nodiscard]] constexpr std::optional<T> find_named(const std::array<Named<T>, N>& table,
                                                    std::string_view name) {
  for (const Named<T>& named : table) {
    if (named.name == name) return named.value;
  }
  return std::nullopt;
}

/// Returns the name of a value; empty if the table lacks it.
template <class T, std::size_t N>
[[nodiscard]] constexpr std::string_view name_of(const std::array<Named<T>, N>& table, T value) {
  for (const Named<T>& named : table) {
    if (named.value == value) return named.name;
  }
  return {};
}

/// Returns all names with `separator` between them.
template <class T, std::size_t N>
[[nodiscard]] std::string list_names(const std::array<Named<T>, N>& table,
                                     std::string_view separator) {
  std::string list;
  for (const Named<T>& named : table) {
    if (!list.empty()) list += separator;
    list += named.name;
  }
  return list;
}

}  // namespace relief

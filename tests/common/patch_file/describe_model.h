// A model as text, in which two readers of the patch file can be compared.
#pragma once

#include <fmt/format.h>

#include <string>

#include "common/patch.h"

namespace relief::test {

template <class Texel>
std::string describe_map(const char* name, const AttributeMap<Texel>& map) {
  if (map.empty()) return fmt::format("{} none\n", name);
  std::string text =
      fmt::format("{} scale {} size {} {}\n", name, map.scale, map.width, map.height);
  for (std::uint32_t j = 0; j < map.height; ++j) {
    for (std::uint32_t i = 0; i < map.width; ++i) {
      const Texel texel = map.texels[std::size_t{j} * map.width + i];
      for (glm::length_t c = 0; c < Texel::length(); ++c) {
        text += fmt::format("{}{}", c > 0 ? "," : (i > 0 ? " " : ""), texel[c]);
      }
    }
    text += '\n';
  }
  return text;
}

inline std::string describe_map(const std::string& name, const AttributeMap<std::uint16_t>& map) {
  std::string text =
      fmt::format("{} scale {} size {} {}\n", name, map.scale, map.width, map.height);
  for (std::uint32_t j = 0; j < map.height; ++j) {
    for (std::uint32_t i = 0; i < map.width; ++i)
      text += fmt::format("{}{}", i > 0 ? " " : "", map.texels[std::size_t{j} * map.width + i]);
    text += '\n';
  }
  return text;
}

inline std::string describe(const ScalarInfo& scalar) {
  std::string text = fmt::format("scalar {}{} offset {:.17g} step {:.17g}\nquantiles", scalar.name,
                                 scalar.is_label ? " label" : "", scalar.offset, scalar.step);
  for (const std::uint16_t code : scalar.quantiles) text += fmt::format(" {}", code);
  return text + '\n';
}

inline std::string describe(const glm::dvec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z);
}

/// Everything of a model: the header's values, then each patch with a row of heights or texels a
/// line; '.' is a hole.
inline std::string describe(const PatchModel& model) {
  std::string text =
      fmt::format("spacing {:.17g}\nbounds {} {}\nradius {:.17g}\n", model.spacing,
                  describe(model.bounds.min), describe(model.bounds.max), model.bounding_radius);
  if (!model.joined.empty()) text += "patches meet at seams\n";
  for (const glm::dvec3& point : model.extremes) text += "extreme " + describe(point) + '\n';
  if (model.stance != Stance{}) {
    text += fmt::format("stands {} {} {}\n", describe(model.stance.up),
                        describe(model.stance.front), model.stance.is_from_sensor ? 1 : 0);
  }
  for (const ScalarInfo& scalar : model.scalars) text += describe(scalar);
  for (const Patch& patch : model.patches) {
    text += fmt::format("patch {} {} spacing {:.17g} step {:.17g}\norigin {}\naxes {} {} {}\n",
                        patch.width, patch.height, patch.spacing, patch.height_step,
                        describe(patch.origin), describe(patch.axes[0]), describe(patch.axes[1]),
                        describe(patch.axes[2]));
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (i > 0) text += ' ';
        text += patch.at(i, j) == kHole ? "." : fmt::format("{}", patch.at(i, j));
      }
      text += '\n';
    }
    text += describe_map("normals", patch.normals);
    text += describe_map("colours", patch.colours);
    for (std::size_t k = 0; k < patch.scalars.size(); ++k)
      text += describe_map(fmt::format("scalar {}", k), patch.scalars[k]);
  }
  return text;
}

}  // namespace relief::test

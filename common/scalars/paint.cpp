#include "common/scalars/paint.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "common/scalars/quantise.h"

namespace relief {
namespace {

/// Gives every texel that is not known the colour of one beside it that is, outward from the known
/// ones: means would be colours of no label.
void spread_outward(AttributeMap<glm::u8vec3>& map, std::vector<std::uint8_t>& known) {
  std::vector<std::size_t> queue;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (known[k] != 0) queue.push_back(k);
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const std::size_t from = queue[head];
    const std::size_t i = from % map.width;
    const std::size_t j = from / map.width;
    for (std::size_t y = j > 0 ? j - 1 : 0; y <= j + 1 && y < map.height; ++y) {
      for (std::size_t x = i > 0 ? i - 1 : 0; x <= i + 1 && x < map.width; ++x) {
        const std::size_t to = y * map.width + x;
        if (known[to] != 0) continue;
        known[to] = 1;
        map.texels[to] = map.texels[from];
        queue.push_back(to);
      }
    }
  }
}

void paint(const AttributeMap<std::uint16_t>& codes, const ScalarInfo& scalar,
           const ColourScale& scale, Patch& patch) {
  std::vector<std::uint8_t> known = kept_texels(patch, codes.scale);
  shape_map(patch, codes.scale, patch.colours);
  for (std::size_t k = 0; k < known.size(); ++k) {
    const std::uint16_t code = codes.texels[k];
    if (code != kNoScalar) known[k] = 1;
    if (known[k] == 0) continue;
    patch.colours.texels[k] = code == kNoScalar ? kNoScalarColour : scale.at(scalar.value_of(code));
  }
  if (scale.is_label)
    spread_outward(patch.colours, known);
  else
    continue_over_holes(patch.colours, known);
}

/// The labels at samples.
std::vector<std::uint32_t> labels_of(std::size_t number, const PatchModel& model) {
  std::vector<std::uint8_t> occurs(std::size_t{kNoScalar} + 1, 0);
  for (const Patch& patch : model.patches) {
    if (number >= patch.scalars.size()) continue;
    const AttributeMap<std::uint16_t>& codes = patch.scalars[number];
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        occurs[codes.texels[std::size_t{j} * codes.scale * codes.width +
                            std::size_t{i} * codes.scale]] = 1;
      }
    }
  }
  std::vector<std::uint32_t> labels;
  for (std::uint16_t code = 0; code < kNoScalar; ++code) {
    if (occurs[code] != 0)
      labels.push_back(static_cast<std::uint32_t>(model.scalars[number].value_of(code)));
  }
  return labels;
}

}  // namespace

void paint_scalar(std::size_t number, ColourScale& scale, PatchModel& model) {
  if (scale.is_label) scale.labels = labels_of(number, model);
  const ScalarInfo scalar = model.scalars[number];
  tbb::parallel_for(std::size_t{0}, model.patches.size(), [&](std::size_t p) {
    Patch& patch = model.patches[p];
    if (number < patch.scalars.size()) {
      const AttributeMap<std::uint16_t> codes = std::move(patch.scalars[number]);
      paint(codes, scalar, scale, patch);
    } else {
      patch.colours = {};
    }
    patch.scalars = {};
  });
  model.scalars = {};
  model.has_colours = true;
  model.has_label_colours = scale.is_label;
}

void paint_heights(const ColourScale& scale, glm::dvec3 up, PatchModel& model) {
  tbb::parallel_for(std::size_t{0}, model.patches.size(), [&](std::size_t p) {
    Patch& patch = model.patches[p];
    patch.scalars = {};
    shape_map(patch, 1, patch.colours);
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      for (std::uint32_t i = 0; i < patch.width; ++i) {
        if (patch.at(i, j) == kHole) continue;
        patch.colours.texels[std::size_t{j} * patch.width + i] =
            scale.at(glm::dot(position_of(patch, i, j), up));
      }
    }
    continue_over_holes(patch.colours, kept_texels(patch, 1));
  });
  model.scalars = {};
  model.has_colours = true;
  model.has_label_colours = false;
}

Quantiles height_quantiles(const PatchModel& model, glm::dvec3 up) {
  std::vector<double> heights;
  heights.reserve(count_samples(model));
  for_each_position(std::span(model.patches),
                    [&](const glm::dvec3& position) { heights.push_back(glm::dot(position, up)); });
  return find_quantiles(heights).value_or(Quantiles{});
}

}  // namespace relief

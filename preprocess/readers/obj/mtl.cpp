#include "preprocess/readers/obj/mtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "common/image/srgb.h"
#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"

namespace relief {
namespace {

/// An option of a map with the words that follow it; of vectors the second and third may be left
/// out.
struct MapOption {
  std::string_view name;
  int words = 1;
  bool numbers = false;  ///< only words that are numbers belong to it
  bool harmless = true;  ///< the image is the same without it
};

constexpr std::array<MapOption, 13> kMapOptions{{{"-blendu", 1},
                                                 {"-blendv", 1},
                                                 {"-bm", 1, true},
                                                 {"-boost", 1},
                                                 {"-cc", 1},
                                                 {"-clamp", 1},
                                                 {"-imfchan", 1, false, false},
                                                 {"-mm", 2, true, false},
                                                 {"-o", 3, true, false},
                                                 {"-s", 3, true, false},
                                                 {"-t", 3, true, false},
                                                 {"-texres", 1},
                                                 {"-type", 1}}};

/// An offset of 0, a scale of 1 and a base and gain of 0 1 change nothing; exporters write them.
bool changes_nothing(std::string_view option, const std::vector<double>& values) {
  const auto all = [&values](double neutral) {
    return std::all_of(values.begin(), values.end(), [=](double v) { return v == neutral; });
  };
  if (option == "-s") return all(1.0);
  if (option == "-mm") return values == std::vector<double>{0.0, 1.0};
  return (option == "-o" || option == "-t") && all(0.0);
}

/// The statement of a map.
struct MapStatement {
  std::string file;
  bool clamps = false;    ///< -clamp on
  float strength = 1.0F;  ///< -bm
  std::string ignored;    ///< options that would change the image
};

MapStatement read_map(TextCursor& line) {
  MapStatement out;
  while (line.peek().starts_with('-')) {
    const auto* const option =
        std::find_if(kMapOptions.begin(), kMapOptions.end(),
                     [&](const MapOption& o) { return o.name == line.peek(); });
    if (option == kMapOptions.end()) break;  // a file's name may begin with a dash
    (void)line.word();
    std::vector<double> values;
    for (int k = 0; k < option->words; ++k) {
      double value = 0.0;
      if (option->numbers && !line.number(value)) break;
      if (option->numbers) values.push_back(value);
      if (!option->numbers && line.word() == "on" && option->name == "-clamp") out.clamps = true;
    }
    if (option->name == "-bm" && !values.empty() &&
        std::abs(values[0]) <= MeshNormalMap::kLargestScale)
      out.strength = static_cast<float>(values[0]);
    if (option->harmless || changes_nothing(option->name, values)) continue;
    if (!out.ignored.empty()) out.ignored += ' ';
    out.ignored += option->name;
  }
  out.file = trimmed(line.rest_of_line());
  return out;
}

/// Kd R G B, or only R for a grey. Spectral curves and CIE XYZ are not read.
std::optional<glm::vec3> read_colour(TextCursor& line) {
  glm::dvec3 srgb(0.0);
  if (!line.number(srgb.r)) return std::nullopt;
  if (!line.number(srgb.g)) {
    srgb.g = srgb.b = srgb.r;
  } else if (!line.number(srgb.b)) {
    return std::nullopt;
  }
  const auto channel = [](double v) {
    return v > 0.0 ? linear_from_srgb(static_cast<float>(std::min(v, 1.0))) : 0.0F;
  };
  return glm::vec3(channel(srgb.r), channel(srgb.g), channel(srgb.b));
}

void take_colours(MapStatement map, MtlMaterial& out) {
  out.material.image = std::move(map.file);
  out.material.clamps = map.clamps;
  out.ignored_options = std::move(map.ignored);
}

void take_normals(MapStatement map, MtlMaterial& out) {
  out.material.normals.image = std::move(map.file);
  out.material.normals.clamps = map.clamps;
  out.material.normals.scale = map.strength;
  out.ignored_of_normals = std::move(map.ignored);
}

}  // namespace

Result<std::vector<MtlMaterial>> read_mtl(const std::string& name, std::string_view text) {
  std::vector<MtlMaterial> materials;
  TextCursor line(text);
  while (line.next_line()) {
    const std::string_view keyword = line.word();
    if (keyword.starts_with('#')) continue;
    if (keyword == "newmtl") {
      materials.emplace_back();
      materials.back().material.name = trimmed(line.rest_of_line());
      continue;
    }
    if (materials.empty()) continue;
    MtlMaterial& material = materials.back();
    const std::string lower = lower_case(keyword);
    if (keyword == "Kd") {
      if (const auto colour = read_colour(line)) material.material.colour = *colour;
    } else if (lower == "map_kd" || lower == "norm" || lower == "map_kn") {
      MapStatement map = read_map(line);
      if (map.file.empty())
        return make_error("{}: line {}: {} names no file", name, line.line_number(), keyword);
      if (lower == "map_kd") {
        take_colours(std::move(map), material);
      } else {
        take_normals(std::move(map), material);
      }
    } else if (lower == "map_bump" || lower == "bump") {
      material.material.normals.left_out = fmt::format(
          "{} holds heights, which are not read (a normal map is named by norm)", keyword);
    }
  }
  for (MtlMaterial& material : materials) {
    if (!material.material.normals.image.empty()) material.material.normals.left_out.clear();
  }
  return materials;
}

}  // namespace relief

// A scene without transparency pays for none: no shader line, no pass, no byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "renderer/gl/program.h"
#include "renderer/gl/shader/feature_names.h"
#include "renderer/gl/shader/preprocess_shader.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

/// What only transparent and refracting surfaces need, in the names of functions and variables.
constexpr const char* kWords[] = {"opacity",    "refract",    "glass",       "splitray",
                                  "split_ray",  "next_layer", "layer_depth", "leave_body",
                                  "transparen", "interface"};

/// The same in the names of textures, buffers and passes.
constexpr const char* kResources[] = {"layer",      "back coordinates", "back depth",
                                      "back frame", "bodies",           "over"};

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The first of the words that a text has; empty if it has none.
std::string word_in(const std::string& text, std::span<const char* const> words) {
  const std::string small = lower(text);
  for (const char* const word : words) {
    if (small.find(word) != std::string::npos) return word;
  }
  return {};
}

Features features_named(const std::vector<std::string>& names) {
  Features features;
  for (const std::string& name : names) {
    if (name.starts_with("lights ")) {
      features.lights = static_cast<std::uint32_t>(std::stoi(name.substr(7)));
      continue;
    }
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1U) {
      if (feature_names(bit) == std::vector<std::string>{name}) features |= bit;
    }
  }
  return features;
}

/// The code of a shader without what all shaders have: constants and layouts, which take neither
/// time nor memory.
std::string own_code(const std::string& path, Features features) {
  std::set<std::string> shared;
  std::string line;
  for (std::istringstream lines(preprocess_shader(resolve_shader("include/shared.h", features)));
       std::getline(lines, line);)
    shared.insert(line);
  std::string code;
  for (std::istringstream lines(preprocess_shader(resolve_shader(path, features)));
       std::getline(lines, line);) {
    if (!shared.contains(line)) code += line + "\n";
  }
  return code;
}

/// Where an image has something of transparency; empty if it has nothing.
std::string transparency_in(const Explanation& explanation) {
  for (const Explanation::Variant& variant : explanation.variants) {
    for (const std::string& path : {variant.vertex, variant.fragment}) {
      const std::string word = word_in(own_code(path, features_named(variant.features)), kWords);
      if (!word.empty()) return path + " has " + word;
    }
    for (const char* const feature : {"layered", "glass", "two_interfaces"}) {
      if (std::ranges::find(variant.features, feature) != variant.features.end())
        return variant.name + " has " + feature;
    }
  }
  for (const auto* const kind : {&explanation.buffers, &explanation.textures}) {
    for (const Explanation::Memory& memory : *kind) {
      if (!word_in(memory.name, kResources).empty()) return "memory for " + memory.name;
    }
  }
  for (const std::string& pass : explanation.passes) {
    if (!word_in(pass, kResources).empty()) return "pass " + pass;
  }
  return {};
}

Explanation explain(const PatchModel& model, RenderSettings settings) {
  settings.explain = true;
  const RenderResult result = test::must_render(model, settings);
  EXPECT_TRUE(result.explanation);
  return result.explanation.value_or(Explanation{});
}

TEST(OpaqueScenes, PayForNoTransparency) {
  const PatchModel model = test::coarse_coloured_sphere();
  for (const Material material : {Material::Unlit, Material::Lit, Material::Mirror}) {
    RenderSettings settings = test::small_image(model);
    settings.material = material;
    for (const test::Method& method : test::all_methods()) {
      settings.primitive = method.primitive;
      settings.interpolation = method.interpolation;
      EXPECT_EQ(transparency_in(explain(model, settings)), "") << method.name;
    }
    settings.engine = "multipass";
    settings.primitive = Primitive::Quad;
    EXPECT_EQ(transparency_in(explain(model, settings)), "") << "multipass";
  }
}

TEST(OpaqueScenes, SeveralMaterialsPayForNoneEither) {
  PatchModel model = test::coarse_coloured_sphere();
  model.patches.back().material = 1;
  RenderSettings settings = test::small_image(model);
  settings.materials = {{Material::Lit, {}}, {Material::Mirror, {}}};
  settings.outputs = test::all_outputs();
  EXPECT_EQ(transparency_in(explain(model, settings)), "");
}

/// The check sees what transparent scenes take.
TEST(OpaqueScenes, TransparentOnesDoPay) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = test::small_image(model);
  settings.constants.opacity = 0.5F;
  EXPECT_NE(transparency_in(explain(model, settings)), "");
  settings = test::small_image(model);
  settings.material = Material::Glass;
  EXPECT_NE(transparency_in(explain(model, settings)), "");
}

/// Opaque glass and lit surfaces that are half transparent pay each for their own.
TEST(OpaqueScenes, GlassHasNoLayersAndLayersNoGlass) {
  const PatchModel model = test::coarse_coloured_sphere();
  RenderSettings settings = test::small_image(model);
  settings.material = Material::Glass;
  for (const Explanation::Variant& variant : explain(model, settings).variants) {
    const std::string code = own_code(variant.fragment, features_named(variant.features));
    EXPECT_EQ(code.find("opacity_of"), std::string::npos) << variant.name;
    EXPECT_EQ(code.find("split_within"), std::string::npos) << variant.name;
  }
  settings.material = Material::Lit;
  settings.constants.opacity = 0.5F;
  for (const Explanation::Variant& variant : explain(model, settings).variants) {
    EXPECT_EQ(own_code(variant.fragment, features_named(variant.features)).find("SplitRay"),
              std::string::npos)
        << variant.name;
  }
}

}  // namespace
}  // namespace relief

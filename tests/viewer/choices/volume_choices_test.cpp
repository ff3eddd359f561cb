#include "viewer/choices/volume_choices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "viewer/choices/engine_choices.h"

namespace relief {
namespace {

ScalarVolume volume_of(std::vector<float> values) {
  return {{static_cast<std::uint32_t>(values.size()), 1, 1}, RegularGrid{}, std::move(values)};
}

TEST(VolumeChoices, ValuesAreThoseOfAllVolumes) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  LoadedScene scene;
  EXPECT_FALSE(values_of(scene));
  scene.volume = volume_of({3.0F, kNone, -2.0F});
  EXPECT_EQ(values_of(scene)->min, -2.0);
  EXPECT_EQ(values_of(scene)->max, 3.0);
  scene.volume = volume_of({3.0F, 3.0F});
  EXPECT_FALSE(values_of(scene)) << "nothing to choose between";
  scene.volume.reset();
  scene.volumes.emplace();
  scene.volumes->list = {{volume_of({1.0F, 2.0F})}, {GaussianCloud{}}, {volume_of({7.0F})}};
  EXPECT_EQ(values_of(scene)->min, 1.0);
  EXPECT_EQ(values_of(scene)->max, 7.0);
}

TEST(VolumeChoices, AFileInForceIsOffered) {
  const std::vector<std::string> usual = offered_transfers("auto");
  EXPECT_EQ(usual.front(), "auto");
  EXPECT_EQ(std::count(usual.begin(), usual.end(), "ct-bone"), 1);
  const std::vector<std::string> with_file = offered_transfers("mine.json");
  EXPECT_EQ(with_file.size(), usual.size() + 1);
  EXPECT_EQ(with_file.back(), "mine.json");
}

TEST(VolumeChoices, OnlyEnginesThatDrawThemAreOffered) {
  LoadedScene scene;
  scene.volumes.emplace();
  std::vector<std::string> names;
  for (const EngineEntry* engine : engines_for(scene.forms())) names.push_back(engine->name);
  EXPECT_EQ(names, (std::vector<std::string>{"volume", "volume-reference"}));
}

}  // namespace
}  // namespace relief

#include "viewer/inspecting/inspection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>

#include "renderer/geometry/cells/levels.h"
#include "viewer/inspecting/inspection_colours.h"

namespace relief {
namespace {

double distance(glm::u8vec3 a, glm::u8vec3 b) {
  const glm::dvec3 d = glm::dvec3(a) - glm::dvec3(b);
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

TEST(Inspection, CyclesInBothDirections) {
  EXPECT_EQ(next_inspection(Inspection::Picture, 1), Inspection::Patches);
  EXPECT_EQ(next_inspection(Inspection::Difference, 1), Inspection::Picture);
  EXPECT_EQ(next_inspection(Inspection::Picture, -1), Inspection::Difference);
}

TEST(Inspection, APictureAsksForNothing) {
  const RenderSettings look = inspected({}, Inspection::Picture);
  EXPECT_FALSE(look.outputs.normal || look.outputs.uv || look.outputs.patch_id);
  EXPECT_FALSE(look.count_fragments);
}

TEST(Inspection, AsksForTheOutputsThatItShows) {
  RenderSettings mirror;
  mirror.material = Material::Mirror;
  const RenderSettings patches = inspected(mirror, Inspection::Patches);
  EXPECT_TRUE(patches.outputs.patch_id && patches.outputs.normal);
  EXPECT_FALSE(patches.outputs.uv);
  EXPECT_EQ(patches.material, Material::Unlit);
  EXPECT_TRUE(inspected(mirror, Inspection::Cells).outputs.uv);
  // What is counted depends on the look.
  const RenderSettings overdraw = inspected(mirror, Inspection::Overdraw);
  EXPECT_TRUE(overdraw.count_fragments);
  EXPECT_EQ(overdraw.material, Material::Mirror);
}

TEST(InspectionColours, PatchesSideBySideDiffer) {
  // A fifth of the way from black to white.
  for (std::uint32_t id = 0; id < 300; ++id) {
    for (std::uint32_t step = 1; step <= 3; ++step)
      EXPECT_GT(distance(patch_colour(id), patch_colour(id + step)), 88.0) << id << " " << step;
  }
}

TEST(InspectionColours, LevelsBecomeDarker) {
  const auto light = [](glm::u8vec3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (std::uint32_t level = 1; level < kMaxLevels; ++level)
    EXPECT_LT(light(level_colour(level)), light(level_colour(level - 1)));
  const auto colours = colours_of(Inspection::Levels);
  EXPECT_EQ(colours[0], level_colour(0));
  EXPECT_EQ(colours[255], kAfarColour);
}

TEST(InspectionColours, ScalesHaveBothEnds) {
  const auto colours = colours_of(Inspection::Overdraw);
  EXPECT_EQ(colours.front(), colour_at(kFragmentMap, 0.0));
  EXPECT_EQ(colours.back(), colour_at(kFragmentMap, 1.0));
}

}  // namespace
}  // namespace relief

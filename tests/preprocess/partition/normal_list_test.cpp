#include "preprocess/partition/normal_list.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

namespace relief {
namespace {

TEST(NormalList, FindsTheFarthestNormalOfAnyNumber) {
  std::mt19937 random(1);
  std::normal_distribution<float> any;
  const auto direction = [&] {
    return glm::normalize(glm::vec3(any(random), any(random), any(random)));
  };
  NormalList list;
  // Up and down again, so that what a longer list left behind is seen if it is read.
  for (const std::size_t size : {1U, 2U, 5U, 40U, 7U, 4U, 3U}) {
    list.resize(size);
    const glm::vec3 axis = direction();
    float least = 2.0F;
    std::size_t farthest = 0;
    for (std::size_t m = 0; m < size; ++m) {
      list.set(m, direction());
      const float cosine = glm::dot(axis, list.at(m));
      if (cosine < least) farthest = m;
      least = std::min(least, cosine);
    }
    EXPECT_FLOAT_EQ(list.min_cosine(axis), least) << size;
    EXPECT_EQ(list.find(axis, list.min_cosine(axis)), farthest) << size;
  }
}

}  // namespace
}  // namespace relief

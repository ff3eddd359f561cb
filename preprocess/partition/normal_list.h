// Normals stored so that SIMD compares four with an axis at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <glm/vec3.hpp>
#include <vector>

namespace relief {

/// Normals as separate coordinate arrays. Keeps its memory when it shrinks.
class NormalList {
 public:
  void resize(std::size_t size) {
    size_ = size;
    if (x_.size() >= size + kAtOnce) return;
    for (std::vector<float>* axis : {&x_, &y_, &z_}) axis->resize(2 * size + kAtOnce);
  }

  void set(std::size_t m, glm::vec3 normal) {
    x_[m] = normal.x;
    y_[m] = normal.y;
    z_[m] = normal.z;
  }

  [[nodiscard]] glm::vec3 at(std::size_t m) const { return {x_[m], y_[m], z_[m]}; }

  /// Returns the smallest dot product of a normal with an axis; 2 without normals.
  [[nodiscard]] float min_cosine(glm::vec3 axis) const {
    Floats smallest = Floats{} + 2.0F;
    std::size_t m = 0;
    for (; m + kAtOnce <= size_; m += kAtOnce) {
      const Floats c = cosines(m, axis);
      smallest = c < smallest ? c : smallest;
    }
    float result = 2.0F;
    for (std::size_t lane = 0; lane < kAtOnce; ++lane) result = std::min(result, smallest[lane]);
    const Floats rest = cosines(m, axis);
    for (std::size_t lane = 0; m + lane < size_; ++lane) result = std::min(result, rest[lane]);
    return result;
  }

  /// Returns the first normal with this product with the axis; the first of all if none has it.
  [[nodiscard]] std::size_t find(glm::vec3 axis, float cosine) const {
    for (std::size_t m = 0; m < size_; m += kAtOnce) {
      const Floats c = cosines(m, axis);
      for (std::size_t lane = 0; lane < kAtOnce && m + lane < size_; ++lane) {
        if (c[lane] == cosine) return m + lane;
      }
    }
    return 0;
  }

 private:
  static constexpr std::size_t kAtOnce = 4;
  using Floats = float __attribute__((vector_size(4 * sizeof(float))));

  static Floats load(const float* from) {
    Floats values;
    std::memcpy(&values, from, sizeof values);
    return values;
  }

  /// Products of the normals from m on; undefined beyond the last one.
  [[nodiscard]] Floats cosines(std::size_t m, glm::vec3 axis) const {
    return axis.x * load(x_.data() + m) + axis.y * load(y_.data() + m) +
           axis.z * load(z_.data() + m);
  }

  std::size_t size_ = 0;
  std::vector<float> x_;  // padded for reads beyond the last
  std::vector<float> y_;
  std::vector<float> z_;
};

}  // namespace relief

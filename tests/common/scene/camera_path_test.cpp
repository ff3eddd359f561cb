// Camera paths: their files, and how the camera moves.
#include "common/scene/views/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <random>

namespace relief {
namespace {

CameraPath parsed(const std::string& text) {
  auto path = parse_camera_path(text, "p.json");
  if (path) return *path;
  ADD_FAILURE() << path.error().message;
  return {};
}

std::string refused(const std::string& text) {
  const auto path = parse_camera_path(text, "p.json");
  return path ? "read" : path.error().message;
}

/// Keys one second apart that see the origin from these eyes.
CameraPath path_from(const std::vector<glm::dvec3>& eyes, bool is_loop = false) {
  CameraPath path;
  path.is_loop = is_loop;
  for (const glm::dvec3& eye : eyes) {
    const double time = static_cast<double>(path.keys.size());
    path.keys.push_back({"", time, {eye, {0, 0, 0}, {0, 0, 1}, 45.0}});
  }
  return path;
}

bool is_finite(const Camera& camera) {
  const glm::dvec3 sum = camera.eye + camera.target + camera.up;
  return std::isfinite(sum.x + sum.y + sum.z + camera.vertical_fov_degrees +
                       camera.orthographic_height);
}

/// How far cameras are apart: of their eyes, plus the angle between their axes.
double difference(const Camera& a, const Camera& b) {
  const glm::dmat3 x = glm::transpose(view_rotation(a));
  const glm::dmat3 y = glm::transpose(view_rotation(b));
  double sum = glm::distance(a.eye, b.eye);
  for (const glm::length_t c : {0, 1, 2}) sum += glm::distance(x[c], y[c]);
  return sum;
}

constexpr const char* kTwoKeys = R"({"version": 1, "keys": [
  {"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0]},
  {"name": "side", "eye": [5, 0, 0], "target": [0, 0, 0], "up": [0, 2, 0], "fov": 30}]})";

TEST(CameraPathFile, HasTimesAndAFieldOfViewByDefault) {
  const CameraPath path = parsed(kTwoKeys);
  ASSERT_EQ(path.keys.size(), 2U);
  EXPECT_EQ(path.keys[0].time, 0.0);
  EXPECT_EQ(path.keys[1].time, 2.0);
  EXPECT_EQ(path.keys[0].camera.vertical_fov_degrees, 45.0);
  EXPECT_EQ(path.keys[1].camera.vertical_fov_degrees, 30.0);
  EXPECT_EQ(path.keys[1].name, "side");
  EXPECT_FALSE(path.is_loop);
  EXPECT_FALSE(path.frames_per_second);
  EXPECT_EQ(duration_of(path), 2.0);
}

TEST(CameraPathFile, ReadsBackToTheBit) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&](double size) {
    return size * glm::dvec3(unit(random), unit(random), unit(random));
  };
  CameraPath path;
  path.frames_per_second = 29.97;
  path.is_loop = true;
  for (int k = 0; k < 50; ++k) {
    path.keys.push_back({k % 2 == 0 ? "" : "Zürich \"1\"",
                         k + 0.1 * (1.0 + unit(random)),
                         {vector(1e7), vector(1e-7), vector(1.0), 45.0 + 40.0 * unit(random),
                          123.0 * (2.0 + unit(random))}});
  }
  const CameraPath read = parsed(camera_path_text(path));
  EXPECT_EQ(read.frames_per_second, path.frames_per_second);
  EXPECT_EQ(read.is_loop, path.is_loop);
  ASSERT_EQ(read.keys.size(), path.keys.size());
  for (std::size_t k = 0; k < path.keys.size(); ++k) {
    EXPECT_EQ(read.keys[k].name, path.keys[k].name);
    EXPECT_EQ(read.keys[k].time, path.keys[k].time);
    EXPECT_EQ(read.keys[k].camera.eye, path.keys[k].camera.eye);
    EXPECT_EQ(read.keys[k].camera.target, path.keys[k].camera.target);
    EXPECT_EQ(read.keys[k].camera.up, path.keys[k].camera.up);
    EXPECT_EQ(read.keys[k].camera.vertical_fov_degrees, path.keys[k].camera.vertical_fov_degrees);
    EXPECT_EQ(read.keys[k].camera.orthographic_height, path.keys[k].camera.orthographic_height);
  }
}

TEST(CameraPathFile, SaysWhatIsWrongAndWhere) {
  const std::string key = R"({"eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0])";
  const auto with = [&](const std::string& first, const std::string& second) {
    return refused(R"({"version": 1, "keys": [)" + key + first + "}, " + key + second + "}]}");
  };
  EXPECT_EQ(with("", R"(, "time": 0)"),
            "p.json: keys[1].time: is 0 s, not after the 0 s of the key before; times ascend");
  EXPECT_EQ(with("", R"(, "time": -1)"),
            "p.json: keys[1].time: expected seconds from 0 to 1e6; found -1");
  EXPECT_EQ(with("", R"(, "fov": 0)"),
            "p.json: keys[1].fov: expected degrees from 0.01 to 175; found 0");
  EXPECT_EQ(with("", R"(, "orthographic": 2)"),
            "p.json: keys[1]: is orthographic or perspective unlike the first key; all keys are "
            "alike");
  EXPECT_EQ(with("", R"(, "roll": 2)"),
            "p.json: keys[1]: does not know the key \"roll\"; expected name, time, eye, target, "
            "up, fov, orthographic");
  EXPECT_EQ(with("", R"(, "name": 3)"),
            "p.json: keys[1].name: expected a text of at most 1000 bytes; found 3");
  EXPECT_EQ(with("", R"(, "up": [0, 1, 0])"), "p.json: an object has the key \"up\" twice");
  EXPECT_EQ(refused(R"({"version": 2, "keys": []})"),
            "p.json: version: expected 1, the only version that there is; found 2");
  EXPECT_EQ(refused(R"({"keys": []})"), "p.json: version: is missing; expected 1");
  EXPECT_EQ(refused(R"({"version": 1})"),
            "p.json: keys: is missing; expected a list of cameras, at least two");
  EXPECT_EQ(refused(R"({"version": 1, "keys": []})"),
            "p.json: keys: expected a list of keys, at least one; found an empty list");
  EXPECT_EQ(refused(R"({"version": 1, "keys": [)" + key + "}]}"),
            "p.json: keys: has a single camera; a path has at least two");
  EXPECT_EQ(refused(R"({"version": 1, "keys": [{"eye": [1, 2, 3], "target": [1, 2, 3],
                       "up": [0, 1, 0]}]})"),
            "p.json: keys[0]: the eye is where its target is");
  EXPECT_EQ(refused(R"({"version": 1, "keys": [{"eye": [1, 2, 0], "target": [1, 2, 3],
                       "up": [0, 1e-200, 0]}]})"),
            "p.json: keys[0].up: is no direction; its length is at least 1e-12");
  EXPECT_EQ(refused(R"({"version": 1, "keys": [{"eye": [1, 2, 1e300], "target": [1, 2, 3],
                       "up": [0, 1, 0]}]})"),
            "p.json: keys[0].eye[2]: expected a number from -1e+12 to 1e+12; found 1e+300");
  EXPECT_EQ(refused(R"({"version": 1, "frames_per_second": 1000, "keys": []})"),
            "p.json: frames_per_second: expected frames per second from 1 to 240; found 1000");
  EXPECT_EQ(refused("["),
            "p.json: line 1, column 2: is no JSON: syntax error while parsing value "
            "- unexpected end of input; expected '[', '{', or a literal");
}

TEST(CameraPathFile, RefusesEveryBeginningOfAFile) {
  const std::string text = kTwoKeys;
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_FALSE(parse_camera_path(text.substr(0, length), "p.json")) << length;
}

TEST(CameraPathFile, IsWrittenAndRead) {
  const auto file = std::filesystem::temp_directory_path() / "relief_camera_path_test.json";
  ASSERT_TRUE(write_camera_path(file, path_from({{0, -5, 0}, {5, 0, 0}})));
  const auto path = read_camera_path(file);
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_EQ(path->keys[1].camera.eye, glm::dvec3(5, 0, 0));
  std::filesystem::remove(file);
  EXPECT_FALSE(read_camera_path(file));
}

/// A path with turns, waits and zooms, at georeferenced coordinates.
CameraPath varied_path() {
  const glm::dvec3 far(5.0e5, 5.0e6, 300.0);
  CameraPath path;
  const auto add = [&](double time, glm::dvec3 eye, glm::dvec3 target, double fov) {
    path.keys.push_back({"", time, {far + eye, far + target, {0, 0, 1}, fov}});
  };
  add(1.0, {0, -50, 10}, {0, 0, 0}, 45.0);
  add(3.0, {40, -10, 10}, {1, 0, 0}, 45.0);
  add(3.5, {0.5, 0.1, 2}, {1, 0, 0}, 20.0);
  add(6.0, {0.5, 0.1, 2}, {1, 0, 0}, 20.0);
  add(7.0, {-300, 80, 400}, {10, 30, 5}, 60.0);
  add(9.0, {10, 30, 500}, {10, 30, 5}, 60.0);  // straight from above
  return path;
}

TEST(CameraPath, GoesThroughItsKeysExactlyAndWithoutAJump) {
  for (const bool is_loop : {false, true}) {
    CameraPath path = varied_path();
    path.is_loop = is_loop;
    for (const CameraKey& key : path.keys) {
      const Camera at = camera_at(path, key.time);
      EXPECT_EQ(at.eye, key.camera.eye);
      EXPECT_EQ(at.target, key.camera.target);
      EXPECT_EQ(at.up, key.camera.up);
      EXPECT_EQ(at.vertical_fov_degrees, key.camera.vertical_fov_degrees);
      // Nor is it elsewhere right before and after.
      if (is_loop || key.time > 1.0) {
        EXPECT_LT(difference(camera_at(path, key.time - 1e-9), at), 1e-5) << key.time;
      }
      if (is_loop || key.time < 9.0) {
        EXPECT_LT(difference(camera_at(path, key.time + 1e-9), at), 1e-5) << key.time;
      }
    }
  }
}

TEST(CameraPath, HasNoVelocityThatJumps) {
  for (const bool is_loop : {false, true}) {
    CameraPath path = varied_path();
    path.is_loop = is_loop;
    constexpr double kStep = 1e-3;
    const auto velocity = [&](double time) {
      return (camera_at(path, time + kStep).eye - camera_at(path, time).eye) / kStep;
    };
    const double end = 1.0 + duration_of(path);
    double fastest = 0.0;
    for (double time = 1.0; time + kStep < end; time += kStep)
      fastest = std::max(fastest, glm::length(velocity(time)));
    for (double time = 1.0; time + 2.0 * kStep < end; time += kStep) {
      // Cubics of half a second: the velocity changes by some 10 / 0.5 of the fastest a second.
      EXPECT_LT(glm::distance(velocity(time + kStep), velocity(time)), 40.0 * kStep * fastest)
          << time;
    }
  }
}

TEST(CameraPath, BeginsAndEndsAtRestUnlessItIsALoop) {
  const std::vector<glm::dvec3> round{{5, 0, 0}, {0, 5, 0}, {-5, 0, 0}, {0, -5, 0}};
  const CameraPath open = path_from(round);
  EXPECT_LT(difference(camera_at(open, 0.01), camera_at(open, 0.0)), 0.01);
  EXPECT_LT(difference(camera_at(open, 2.99), camera_at(open, 3.0)), 0.01);
  EXPECT_EQ(camera_at(open, -4.0).eye, round.front());
  EXPECT_EQ(camera_at(open, 70.0).eye, round.back());
  const CameraPath loop = path_from(round, true);
  EXPECT_EQ(duration_of(loop), 4.0);
  EXPECT_GT(difference(camera_at(loop, 0.01), camera_at(loop, 0.0)), 0.05);
  EXPECT_LT(difference(camera_at(loop, 4.25), camera_at(loop, 0.25)), 1e-9);
  EXPECT_LT(difference(camera_at(loop, -0.25), camera_at(loop, 3.75)), 1e-9);
}

TEST(CameraPath, OfALoopAroundAModelIsACircle) {
  const CameraPath loop = path_from({{5, 0, 0}, {0, 5, 0}, {-5, 0, 0}, {0, -5, 0}}, true);
  for (double time = 0.0; time < 4.0; time += 0.01) {
    const Camera camera = camera_at(loop, time);
    EXPECT_NEAR(glm::length(camera.eye), 5.0, 1e-9);
    EXPECT_NEAR(camera.eye.z, 0.0, 1e-9);
    EXPECT_NEAR(camera.vertical_fov_degrees, 45.0, 1e-9);
    EXPECT_LT(glm::distance(camera.up, glm::dvec3(0, 0, 1)), 1e-9);
    // Equal speed: of equal steps the cubics are lines.
    const double angle = 0.5 * std::acos(-1.0) * time;
    EXPECT_LT(glm::distance(camera.eye, 5.0 * glm::dvec3(std::cos(angle), std::sin(angle), 0.0)),
              1e-9);
  }
}

TEST(CameraPath, NeverGoesBeyondTheKeysInDistanceAndFieldOfView) {
  const CameraPath path = varied_path();
  for (std::size_t k = 0; k + 1 < path.keys.size(); ++k) {
    const Camera& a = path.keys[k].camera;
    const Camera& b = path.keys[k + 1].camera;
    const auto [low, high] =
        std::minmax({glm::distance(a.eye, a.target), glm::distance(b.eye, b.target)});
    const auto [narrow, wide] = std::minmax({a.vertical_fov_degrees, b.vertical_fov_degrees});
    for (double u = 0.0; u <= 1.0; u += 0.001) {
      const Camera camera =
          camera_at(path, path.keys[k].time + u * (path.keys[k + 1].time - path.keys[k].time));
      const double distance = glm::distance(camera.eye, camera.target);
      EXPECT_GE(distance, low * (1.0 - 1e-8));  // coordinates are 1e-9 apart
      EXPECT_LE(distance, high * (1.0 + 1e-8));
      EXPECT_GE(camera.vertical_fov_degrees, narrow - 1e-9);
      EXPECT_LE(camera.vertical_fov_degrees, wide + 1e-9);
    }
  }
  // It waits from 3.5 to 6.
  for (double time = 3.5; time < 6.0; time += 0.1)
    EXPECT_LT(difference(camera_at(path, time), path.keys[2].camera), 1e-7) << time;
}

TEST(CameraPath, IsTheSameAtGeoreferencedCoordinates) {
  const CameraPath far = varied_path();
  CameraPath near = far;
  for (CameraKey& key : near.keys) {
    key.camera.eye -= glm::dvec3(5.0e5, 5.0e6, 300.0);
    key.camera.target -= glm::dvec3(5.0e5, 5.0e6, 300.0);
  }
  for (double time = 1.0; time < 9.0; time += 0.01) {
    Camera camera = camera_at(far, time);
    camera.eye -= glm::dvec3(5.0e5, 5.0e6, 300.0);
    camera.target -= glm::dvec3(5.0e5, 5.0e6, 300.0);
    EXPECT_LT(difference(camera, camera_at(near, time)), 1e-7) << time;  // two metres from a wall
  }
}

TEST(CameraPath, IsFiniteWhateverItsKeysAre) {
  std::mt19937 random(5);
  const std::vector<double> coordinates{0.0, 1.0, -1.0, 1e-12, 1e12, -1e12, 5.0e6, 1e-300};
  const auto vector = [&] {
    const auto one = [&] { return coordinates[random() % coordinates.size()]; };
    return glm::dvec3(one(), one(), one());
  };
  for (int n = 0; n < 2000; ++n) {
    CameraPath path;
    path.is_loop = n % 3 == 0;
    double time = 0.0;
    while (path.keys.size() < 4) {
      Camera camera{vector(), vector(), vector(), n % 2 == 0 ? 0.1 : 170.0};
      if (n % 5 == 0) camera.orthographic_height = n % 2 == 0 ? 1e-12 : 1e12;
      if (glm::distance(camera.eye, camera.target) < kShortestSight ||
          glm::length(camera.up) < kShortestSight)
        continue;
      path.keys.push_back({"", time, camera});
      time += n % 7 == 0 ? 1e-9 : 1.0 + time;
    }
    const double duration = duration_of(path);
    for (double u = -0.1; u < 1.1; u += 0.013) {
      const Camera camera = camera_at(path, u * duration);
      ASSERT_TRUE(is_finite(camera)) << n << " " << u;
    }
  }
}

TEST(CameraPath, OfOrthographicKeysChangesTheHeight) {
  CameraPath path = path_from({{0, -5, 0}, {0, -5, 0}, {0, -5, 0}});
  path.keys[0].camera.orthographic_height = 1.0;
  path.keys[1].camera.orthographic_height = 4.0;
  path.keys[2].camera.orthographic_height = 64.0;
  double before = 1.0;
  for (double time = 0.01; time <= 2.0; time += 0.01) {
    const double height = camera_at(path, time).orthographic_height;
    EXPECT_GT(height, before);
    before = height;
  }
  EXPECT_LE(before, 64.0);
}

TEST(CameraPath, HasAsManyFramesAsItsDurationTimesTheRate) {
  const CameraPath path = path_from({{0, -5, 0}, {5, 0, 0}, {0, 5, 0}});
  const auto frames = film_cameras(path, 12.0);
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 24U);
  EXPECT_EQ(frames->front().eye, path.keys[0].camera.eye);
  EXPECT_EQ((*frames)[12].eye, path.keys[1].camera.eye);
  EXPECT_EQ(frames->back().eye, path.keys[2].camera.eye);
  CameraPath loop = path;
  loop.is_loop = true;
  const auto round = film_cameras(loop, 12.0);
  ASSERT_EQ(round->size(), 36U);
  EXPECT_NE(round->back().eye, path.keys[0].camera.eye) << "the first frame follows the last";
  CameraPath brief = path;
  for (CameraKey& key : brief.keys) key.time *= 1e-6;
  EXPECT_EQ(film_cameras(brief, 12.0)->size(), 2U);
  CameraPath slow = path;
  for (CameraKey& key : slow.keys) key.time *= 1e5;
  const auto refused = film_cameras(slow, 30.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "takes 200000 s, which at 30 frames a second are 6000000 frames; at most 100000 are "
            "drawn");
}

}  // namespace
}  // namespace relief

// Where OpenGL comes from, and that it does not matter. Mesa reads its environment once per
// process, so that each case renders in a process of its own.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image_io.h"
#include "common/io/file.h"
#include "renderer/gl/context/library.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

using test::small_image;

/// A scene of overlapping patches in which anything that depended on order would show.
PatchModel small_bumpy_sphere() {
  test::SphereShape shape;
  shape.bumps = 0.1;
  shape.patches_per_side = 2;
  shape.coloured = true;
  return test::sphere_model(shape);
}

/// Renders and writes an EXR, then ends the process: 0, or 1 with the sentence on standard error.
/// Without exit handlers, where Mesa's own leaks would count.
[[noreturn]] void render_and_exit(const RenderSettings& settings, const PatchModel& model,
                                  const std::filesystem::path& path) {
  Progress silent;
  const auto result = render(model, settings, silent);
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::_Exit(1);
  }
  std::_Exit(path.empty() || write_exr(path, result->image) ? 0 : 2);
}

class Platforms : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  void TearDown() override { std::filesystem::remove_all(folder()); }

  /// The same in the child, which runs the test's body again; another in another build, whose tests
  /// may run at the same time.
  static std::filesystem::path folder() {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    return std::filesystem::temp_directory_path() /
           ("relief-platform-" + std::to_string(std::filesystem::hash_value(program)) + "-" +
            testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  static std::vector<std::byte> bytes(const std::string& name) {
    const auto file = read_file(folder() / name);
    EXPECT_TRUE(file) << name;
    return file ? *file : std::vector<std::byte>();
  }
};

bool has_osmesa() {
  return static_cast<bool>(Library::open("libOSMesa.so.8"));
}

constexpr const char* kNoVendors = "__EGL_VENDOR_LIBRARY_FILENAMES";

TEST_F(Platforms, NoOpenGlIsOneSentence) {
  EXPECT_EXIT(
      {
        ::setenv(kNoVendors, "/nonexistent", 1);
        const PatchModel model = test::height_field(4, [](double, double) { return 0.0; });
        RenderSettings settings = small_image(model);
        settings.platform = GlPlatform::Egl;
        render_and_exit(settings, model, {});
      },
      testing::ExitedWithCode(1),
      "^there is no OpenGL .EGL: .*; on Debian install libegl1 and libgl1-mesa-dri\n$");
}

TEST_F(Platforms, OsmesaStandsInForEgl) {
  if (!has_osmesa()) GTEST_SKIP() << "there is no OSMesa";
  EXPECT_EXIT(
      {
        ::setenv(kNoVendors, "/nonexistent", 1);
        const PatchModel model = test::height_field(4, [](double, double) { return 0.0; });
        render_and_exit(small_image(model), model, {});
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(Platforms, NumberOfThreadsChangesNoByte) {
  std::filesystem::create_directory(folder());
  for (const test::Method& method : test::all_methods()) {
    for (const char* threads : {"1", "4"}) {
      const std::string name = std::string(method.name) + threads;
      EXPECT_EXIT(
          {
            ::setenv("LP_NUM_THREADS", threads, 1);
            const PatchModel model = small_bumpy_sphere();
            RenderSettings settings = small_image(model, {20.0, 15.0, 1.4}, 128);
            settings.primitive = method.primitive;
            settings.interpolation = method.interpolation;
            settings.outputs = test::all_outputs();
            render_and_exit(settings, model, folder() / name);
          },
          testing::ExitedWithCode(0), "");
    }
    const std::vector<std::byte> one = bytes(std::string(method.name) + "1");
    EXPECT_GT(one.size(), 1000U);
    EXPECT_TRUE(one == bytes(std::string(method.name) + "4")) << method.name;
  }
}

TEST_F(Platforms, NumberOfThreadsChangesNoByteOfSums) {
  std::filesystem::create_directory(folder());
  for (const Primitive primitive : {Primitive::Quad, Primitive::Sprite}) {
    for (const char* threads : {"1", "4"}) {
      EXPECT_EXIT(
          {
            ::setenv("LP_NUM_THREADS", threads, 1);
            const PatchModel model = small_bumpy_sphere();
            RenderSettings settings = small_image(model, {20.0, 15.0, 1.4}, 128);
            settings.engine = "multipass";
            settings.primitive = primitive;
            settings.outputs = test::all_outputs();
            render_and_exit(settings, model, folder() / threads);
          },
          testing::ExitedWithCode(0), "");
    }
    EXPECT_GT(bytes("1").size(), 1000U);
    EXPECT_TRUE(bytes("1") == bytes("4"));
  }
}

TEST(Osmesa, DrawsWhatEglDraws) {
  if (!has_osmesa()) GTEST_SKIP() << "there is no OSMesa";
  const PatchModel model = small_bumpy_sphere();
  RenderSettings settings = small_image(model);
  for (const test::Method& method : test::all_methods()) {
    settings.primitive = method.primitive;
    settings.interpolation = method.interpolation;
    settings.platform = GlPlatform::Egl;
    const RenderResult egl = test::must_render(model, settings);
    settings.platform = GlPlatform::Osmesa;
    const RenderResult osmesa = test::must_render(model, settings);
    // Both are llvmpipe here. Where EGL is a GPU, silhouettes and ties differ by a pixel here and
    // there, out of 3,000 of rim.
    EXPECT_LE(test::count_different(egl.image, osmesa.image, 2), 60U) << method.name;
  }
}

}  // namespace
}  // namespace relief

// A GPU that is reset, which no test can do: the functions that tell of it are made up.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "renderer/viewport.h"
#include "tests/renderer/gl/draw_viewport.h"
#include "tests/renderer/gl/own_context.h"
#include "tests/renderer/images.h"

namespace relief {
namespace {

/// Whether the GPU was reset. OpenGL's functions can hold nothing, so that this is global.
bool gpu_was_reset = false;

GLenum APIENTRY status_of_gpu() {
  return gpu_was_reset ? GL_INNOCENT_CONTEXT_RESET : GL_NO_ERROR;
}

GLenum APIENTRY was_reset() {
  return GL_UNKNOWN_CONTEXT_RESET;
}

GLenum APIENTRY is_lost() {
  return GL_CONTEXT_LOST;
}

TEST(LostContext, IsOneSentence) {
  test::OwnContext own;
  Gl gl = own.gl();
  EXPECT_TRUE(check_errors(gl, "the model"));
  gl.GetGraphicsResetStatus = &was_reset;
  const Status reset = check_errors(gl, "the model");
  ASSERT_FALSE(reset);
  EXPECT_TRUE(reset.error().message.starts_with("the GPU was reset at the model"))
      << reset.error().message;
  gl = own.gl();
  gl.GetError = &is_lost;
  EXPECT_FALSE(check_errors(gl, "the model"));
}

TEST(LostContext, EndsAWindowsPictureWithThatSentence) {
  test::OwnContext own;
  const GlLoader load = [&own](const char* name) -> GlFunction {
    if (std::string_view(name) == "glGetGraphicsResetStatus")
      return reinterpret_cast<GlFunction>(&status_of_gpu);
    return own.loader()(name);
  };
  const PatchModel model = test::coarse_coloured_sphere();
  const RenderSettings view = test::small_image(model);
  auto viewport = Viewport::create(load, RenderModel::of(model), {&view, 1});
  ASSERT_TRUE(viewport) << viewport.error().message;
  const Texture colour = make_attachment(own.gl(), "picture", GL_RGBA16F, view.width, view.height);
  const Framebuffer into = make_framebuffer(own.gl(), "picture", nullptr, {{0, &colour}});
  EXPECT_TRUE((*viewport)->draw(view, into.id()));
  gpu_was_reset = true;
  const Status drawn = (*viewport)->draw(view, into.id());
  gpu_was_reset = false;
  ASSERT_FALSE(drawn);
  EXPECT_NE(drawn.error().message.find("the GPU was reset"), std::string::npos)
      << drawn.error().message;
}

}  // namespace
}  // namespace relief

// What a viewport draws, in a context of a test's own.
#pragma once

#include <gtest/gtest.h>

#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/viewport.h"

namespace relief::test {

[[nodiscard]] inline Image draw(const Gl& gl, Viewport& viewport, const RenderSettings& view) {
  const Texture colour = make_attachment(gl, "picture", GL_RGBA16F, view.width, view.height);
  const Framebuffer into = make_framebuffer(gl, "picture", nullptr, {{0, &colour}});
  const Status drawn = viewport.draw(view, into.id());
  EXPECT_TRUE(drawn) << drawn.error().message;
  return read_colour(gl, colour, view.width, view.height);
}

}  // namespace relief::test

// What a window shows of a canvas of which a part is drawn anew.
#include "viewer/drawing/presenter.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "tests/renderer/gl/own_context.h"

namespace relief {
namespace {

constexpr std::uint32_t kWidth = 40;
constexpr std::uint32_t kHeight = 2100;  // neighbours are 3 pixels away

class Presents : public testing::Test {
 protected:
  /// A grey surface at a depth, in rows.
  void fill(const Rows& rows, float grey, float depth) {
    const Gl& gl = context_.gl();
    const std::size_t pixels = std::size_t{kWidth} * (rows.top - rows.bottom);
    const std::vector<glm::vec4> colours(pixels, glm::vec4(glm::vec3(grey), 1.0F));
    const std::vector<float> depths(pixels, depth);
    const auto bottom = static_cast<GLint>(rows.bottom);
    const auto height = static_cast<GLsizei>(rows.top - rows.bottom);
    gl.TextureSubImage2D(canvas_.colour.id(), 0, 0, bottom, kWidth, height, GL_RGBA, GL_FLOAT,
                         colours.data());
    gl.TextureSubImage2D(canvas_.depth.id(), 0, 0, bottom, kWidth, height, GL_DEPTH_COMPONENT,
                         GL_FLOAT, depths.data());
  }
  [[nodiscard]] std::vector<std::uint8_t> shown() const {
    std::vector<std::uint8_t> pixels(std::size_t{4} * kWidth * kHeight);
    context_.gl().GetTextureImage(canvas_.shown.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                                  static_cast<GLsizei>(pixels.size()), pixels.data());
    return pixels;
  }

  test::OwnContext context_;
  Canvas canvas_ = *make_canvas(context_.gl(), kWidth, kHeight);
  Presenter presenter_ = *Presenter::create(context_.gl());
};

TEST_F(Presents, RowsThatAreDrawnAnewAndThoseThatSeeThem) {
  constexpr Rows kAll{0, kHeight};
  for (const double shade : {0.0, 1.0}) {
    const Presentation how{.shade = shade};
    for (const Rows band : {Rows{0, 16}, Rows{1000, 1100}, Rows{kHeight - 5, kHeight}}) {
      fill(kAll, 0.5F, 0.01F);
      ASSERT_TRUE(presenter_.encode(canvas_, how, kAll));
      const auto before = shown();
      fill(band, 0.2F, 0.02F);
      ASSERT_TRUE(presenter_.encode(canvas_, how, band));
      const auto after = shown();
      ASSERT_TRUE(presenter_.encode(canvas_, how, kAll));
      EXPECT_EQ(after, shown()) << "rows from " << band.bottom << ", shade " << shade;
      EXPECT_NE(after, before);
    }
  }
}

TEST_F(Presents, WholePicturesToTheByteAndSmallerOnesUpToTheirEdges) {
  const Gl& gl = context_.gl();
  fill({0, kHeight / 2}, 0.0F, 0.01F);
  fill({kHeight / 2, kHeight}, 1.0F, 0.01F);
  ASSERT_TRUE(presenter_.encode(canvas_, {}, {0, kHeight}));
  for (const std::uint32_t factor : {1U, 3U}) {
    const Canvas window = *make_canvas(gl, factor * kWidth, factor * kHeight);
    presenter_.copy(canvas_, {window.width, window.height}, window.shown_framebuffer.id());
    std::vector<std::uint8_t> pixels(std::size_t{4} * window.width * window.height);
    gl.GetTextureImage(window.shown.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                       static_cast<GLsizei>(pixels.size()), pixels.data());
    if (factor == 1) {
      EXPECT_EQ(pixels, shown());
    }
    EXPECT_EQ(pixels.front(), 0U) << "the lowest row, not mixed with the highest";
    EXPECT_EQ(pixels[pixels.size() - 4], 255U);
  }
}

}  // namespace
}  // namespace relief

// What is drawn on the CPU is waited for, fence by fence; what a GPU draws is not.
#include "renderer/gl/drawing/draw_throttle.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace relief {
namespace {

/// OpenGL that makes fences and nothing else, and remembers what became of them.
struct Fences {
  std::set<GLsync> alive;
  std::vector<GLsync> waited;
  int made = 0;
};

Fences* fences = nullptr;

GLsync APIENTRY make_fence(GLenum /*condition*/, GLbitfield /*flags*/) {
  auto* const fence = reinterpret_cast<GLsync>(static_cast<std::uintptr_t>(++fences->made));
  fences->alive.insert(fence);
  return fence;
}

GLenum APIENTRY wait_for(GLsync fence, GLbitfield /*flags*/, GLuint64 /*timeout*/) {
  EXPECT_TRUE(fences->alive.contains(fence));
  fences->waited.push_back(fence);
  return GL_ALREADY_SIGNALED;
}

void APIENTRY delete_fence(GLsync fence) {
  EXPECT_EQ(fences->alive.erase(fence), 1U);
}

template <char Name>
const GLubyte* APIENTRY name_of(GLenum /*what*/) {
  return reinterpret_cast<const GLubyte*>(Name == 'l' ? "llvmpipe (LLVM 15.0.6)" : "NVIDIA H200");
}

class DrawThrottles : public testing::Test {
 protected:
  DrawThrottles() {
    fences = &made_;
    gl_.FenceSync = make_fence;
    gl_.ClientWaitSync = wait_for;
    gl_.DeleteSync = delete_fence;
    gl_.GetString = name_of<'l'>;
  }
  ~DrawThrottles() override { fences = nullptr; }

  Fences made_;
  Gl gl_;
};

TEST_F(DrawThrottles, WaitsForTheFenceBeforeTheLast) {
  DrawThrottle throttle(gl_);
  for (int draw = 0; draw < 8; ++draw) throttle.drew(kTrianglesPerFence / 2);
  EXPECT_EQ(made_.made, 4);
  EXPECT_EQ(made_.waited.size(), 3U);
  EXPECT_EQ(made_.alive.size(), 1U);
}

TEST_F(DrawThrottles, KeepsNoFence) {
  {
    DrawThrottle throttle(gl_);
    throttle.drew(kTrianglesPerFence);
  }
  EXPECT_EQ(made_.made, 1);
  EXPECT_TRUE(made_.alive.empty());
}

TEST_F(DrawThrottles, DoesNotWaitForLittle) {
  DrawThrottle throttle(gl_);
  throttle.drew(kTrianglesPerFence - 1);
  EXPECT_EQ(made_.made, 0);
}

TEST_F(DrawThrottles, NeverWaitsForAGpu) {
  gl_.GetString = name_of<'n'>;
  DrawThrottle throttle(gl_);
  for (int draw = 0; draw < 8; ++draw) throttle.drew(kTrianglesPerFence);
  EXPECT_EQ(made_.made, 0);
}

}  // namespace
}  // namespace relief

#include "renderer/gl/drawing/pass.h"

#include <algorithm>
#include <utility>

#include "common/median.h"
#include "renderer/gl/software.h"

namespace relief {

namespace {

/// llvmpipe starts its timer when a thread begins its last tile: it said 0.2 ms of a frame of 10.
bool has_wrong_timer(const Gl& gl) {
  return renderer_name(gl).starts_with("llvmpipe");
}

double milliseconds_of(const Gl& gl, const Query& query) {
  GLuint64 nanoseconds = 0;
  gl.GetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &nanoseconds);
  return 1e-6 * static_cast<double>(nanoseconds);
}

}  // namespace

PassTimer::PassTimer(const Gl& gl, bool each) : gl_(&gl), each_(each) {
  GLint bits = 0;
  gl.GetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
  available_ = bits > 0 && !has_wrong_timer(gl);
}

std::optional<double> PassTimer::take() {
  if (!available_) return std::nullopt;
  double milliseconds = 0.0;
  for (const Query& query : queries_) milliseconds += milliseconds_of(*gl_, query);
  queries_.clear();
  return milliseconds;
}

std::vector<PassTime> PassTimer::take_each() {
  for (std::size_t k = 0; k < queries_.size(); ++k)
    passes_[k].ms = milliseconds_of(*gl_, queries_[k]);
  queries_.clear();
  return std::exchange(passes_, {});
}

Result<std::vector<PassTime>> time_passes(const Gl& gl, int frames, const Progress& progress,
                                          const std::function<Status(PassTimer&)>& draw) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> ms;  // of each name, by frame
  for (int frame = 0; frame < frames; ++frame) {
    if (progress.cancelled()) return interrupted_error();
    PassTimer timer(gl, true);
    RELIEF_TRY(draw(timer));
    for (const PassTime& pass : timer.take_each()) {
      const auto k = static_cast<std::size_t>(std::ranges::find(names, pass.name) - names.begin());
      if (k == names.size()) {
        names.push_back(pass.name);
        ms.emplace_back(static_cast<std::size_t>(frames), 0.0);
      }
      ms[k][static_cast<std::size_t>(frame)] += pass.ms;
    }
  }
  std::vector<PassTime> passes;
  for (std::size_t k = 0; k < names.size(); ++k) passes.push_back({names[k], median_of(ms[k])});
  return passes;
}

ScopedPass::ScopedPass(const Gl& gl, PassTimer& timer, std::string_view name)
    : gl_(gl), timer_(timer) {
  gl_.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()),
                     name.data());
  if (timer.each_) timer.passes_.push_back({std::string(name), 0.0});
  if (timer.available_) {
    timer.queries_.emplace_back(gl, name, GLenum{GL_TIME_ELAPSED});
    gl_.BeginQuery(GL_TIME_ELAPSED, timer.queries_.back().id());
  } else if (timer.each_) {
    gl_.Finish();
    start_ = std::chrono::steady_clock::now();
  }
}

ScopedPass::~ScopedPass() {
  if (timer_.available_) {
    gl_.EndQuery(GL_TIME_ELAPSED);
  } else if (timer_.each_) {
    gl_.Finish();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start_;
    timer_.passes_.back().ms = elapsed.count();
  }
  gl_.PopDebugGroup();
}

}  // namespace relief

#include "renderer/engines/onepass/render_onepass.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/onepass.h"
#include "renderer/environment.h"
#include "renderer/gl/context.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/pass.h"
#include "renderer/median.h"
#include "renderer/patch_store.h"
#include "renderer/targets.h"
#include "renderer/view.h"

namespace relief::onepass {
namespace {

/// All that a frame needs, made once.
struct Scene {
  View view;
  Targets targets;
  Engine engine;
  std::optional<Texture> environment;
  std::optional<Backdrop> backdrop;
  Buffer frame;  ///< shared::Frame
  glm::vec3 background{0.0F};
};

/// A near plane that no surface that can be told apart from the eye is in front of.
double near_of(const PatchModel& model) {
  double spacing = model.spacing > 0.0 ? model.spacing : 1.0;
  for (const Patch& patch : model.patches) spacing = std::min(spacing, patch.spacing);
  return 0.01 * spacing;
}

Result<Scene> make_scene(const Gl& gl, const PatchModel& model, const PatchStore& store,
                         const RenderSettings& settings, std::uint32_t features) {
  Result<Targets> targets = make_targets(gl, settings.width, settings.height, settings.outputs);
  if (!targets) return targets.error();
  Result<Engine> engine = Engine::create(gl, store, features);
  if (!engine) return engine.error();

  const bool shows_environment = !settings.environment.empty() && settings.background.has_value();
  std::optional<Texture> environment;
  if (shows_environment || settings.material == Material::Mirror) {
    const Result<CubeMap> cube = load_environment(settings.environment);
    if (!cube) return cube.error();
    Result<Texture> made = upload_environment(gl, *cube);
    if (!made) return made.error();
    environment = std::move(*made);
  }
  std::optional<Backdrop> backdrop;
  if (shows_environment) {
    Result<Backdrop> made = Backdrop::create(gl);
    if (!made) return made.error();
    backdrop = std::move(*made);
  }
  const View view = make_view(settings.camera, settings.width, settings.height, near_of(model));
  const shared::Frame frame = make_frame(view, engine->largest_sprite());
  return Scene{view,
               std::move(*targets),
               std::move(*engine),
               std::move(environment),
               std::move(backdrop),
               make_buffer(gl, "frame", std::span<const shared::Frame>(&frame, 1)),
               settings.background.value_or(glm::vec3(0.0F))};
}

/// Draws one frame, without waiting for it.
void draw_frame(const Gl& gl, const Scene& scene, const Engine& engine, PassTimer& timer) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, scene.targets.framebuffer.id());
  gl.Viewport(0, 0, static_cast<GLsizei>(scene.targets.width),
              static_cast<GLsizei>(scene.targets.height));
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, scene.frame.id());
  clear_targets(gl, scene.targets, scene.background);
  engine.draw(scene.view, timer, scene.environment ? &*scene.environment : nullptr);
  if (scene.backdrop) scene.backdrop->draw(timer, *scene.environment);
  gl.BindBufferBase(GL_UNIFORM_BUFFER, RELIEF_BIND_FRAME, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

/// Times frames after one that warms caches up and compiles what OpenGL compiles late.
void time_frames(const Gl& gl, const Scene& scene, int frames, RenderResult& result) {
  PassTimer timer(gl);
  draw_frame(gl, scene, scene.engine, timer);
  gl.Finish();
  (void)timer.take();
  std::vector<double> frame_ms;
  std::vector<double> gpu_ms;
  for (int i = 0; i < std::max(frames, 1); ++i) {
    const auto start = std::chrono::steady_clock::now();
    draw_frame(gl, scene, scene.engine, timer);
    gl.Finish();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    frame_ms.push_back(elapsed.count());
    if (const auto time = timer.take()) gpu_ms.push_back(*time);
  }
  result.frame_ms = median(frame_ms);
  if (!gpu_ms.empty()) result.gpu_ms = median(gpu_ms);
}

/// Counts the fragments of the model's pass, in a frame of its own that is not timed.
Result<std::uint64_t> count_fragments(const Gl& gl, const Scene& scene, const PatchStore& store,
                                      std::uint32_t features) {
  Result<Engine> counting = Engine::create(gl, store, features | RELIEF_FEATURE_COUNT_FRAGMENTS);
  if (!counting) return counting.error();
  std::uint32_t count = 0;
  const Buffer buffer =
      make_buffer(gl, "fragment count", std::span<const std::uint32_t>(&count, 1));
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, buffer.id());
  PassTimer timer(gl);
  draw_frame(gl, scene, *counting, timer);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, RELIEF_BIND_FRAGMENT_COUNT, 0);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl.GetNamedBufferSubData(buffer.id(), 0, sizeof(count), &count);
  return std::uint64_t{count};
}

/// Reads the picture, counts what the model covers and puts an opaque background under it.
void read_picture(const Gl& gl, const Scene& scene, bool opaque, RenderResult& result) {
  result.image = read_targets(gl, scene.targets);
  for (Channel& channel : result.image.channels) {
    if (channel.name != "A") continue;
    result.covered_pixels = static_cast<std::uint64_t>(std::count_if(
        channel.values.begin(), channel.values.end(), [](float alpha) { return alpha > 0.0F; }));
    if (opaque) std::fill(channel.values.begin(), channel.values.end(), 1.0F);
  }
}

}  // namespace

Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings) {
  const auto context = make_context(settings.platform, settings.debug);
  if (!context) return context.error();
  const auto functions = load_functions(**context);
  if (!functions) return functions.error();
  const Gl& gl = *functions;
  std::optional<DebugLog> log;
  if (settings.debug) log.emplace(gl);

  const std::uint32_t features = features_of(settings, model.has_colours);
  const auto store = upload_model(gl, model, needs_of(features));
  if (!store) return store.error();
  const auto scene = make_scene(gl, model, *store, settings, features);
  if (!scene) return scene.error();

  RenderResult result;
  result.renderer = reinterpret_cast<const char*>(gl.GetString(GL_RENDERER));
  const auto fragments = count_fragments(gl, *scene, *store, features);
  if (!fragments) return fragments.error();
  result.fragments = *fragments;
  time_frames(gl, *scene, settings.frames, result);
  read_picture(gl, *scene, settings.background.has_value(), result);
  if (log && !log->status()) return log->status().error();
  const Status drawn = check_errors(gl, "the picture");
  if (!drawn) return drawn.error();
  return result;
}

}  // namespace relief::onepass

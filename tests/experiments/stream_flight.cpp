// A recorded flight over a file with tiles, without a window: how fast the first picture is there,
// what streaming takes, and whether settled pictures are those of `relief render`.
//
//     stream_flight FILE [--poses N] [--frames N] [--seed N] [--memory MB] [--gpu-memory MB]
//                   [--size WxH] [--samples N] [--stills N] [--pictures FOLDER] [--whole]
//
// The camera goes from pose to pose: `--frames` frames of motion, then it rests until everything is
// there. Every `--stills`th settled picture is compared with one of the same view of tiles that
// were read for it alone. `--whole`: measures instead what uploading each view's tiles as one model
// takes.
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/heap.h"
#include "common/image/image_io.h"
#include "common/image/srgb.h"
#include "loader/load_scene.h"
#include "loader/scene/first_look.h"
#include "loader/scene/view_settings.h"
#include "loader/stream/streamed_patches.h"
#include "renderer/frame/targets/attachments.h"
#include "renderer/frame/targets/targets.h"
#include "renderer/gl/context/context.h"
#include "renderer/gl/open_gl.h"
#include "renderer/viewport.h"

namespace relief {
namespace {

struct Arguments {
  std::filesystem::path file;
  int poses = 20;
  int frames = 40;
  unsigned seed = 1;
  std::uint64_t memory = 256;
  std::uint64_t gpu = 1024;
  std::uint32_t width = 1280;
  std::uint32_t height = 800;
  int samples = 4;
  int stills = 5;
  std::filesystem::path pictures;
  bool whole = false;
};

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// CPU time of this thread: what other programs on the machine take does not count.
double thread_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0;
  std::uint64_t resident = 0;
  file >> all >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1e3;
}

template <class T>
T must(Result<T> result) {
  if (result) return *std::move(result);
  std::fprintf(stderr, "%s\n", result.error().message.c_str());
  std::exit(1);
}

void must(const Status& status) {
  if (status) return;
  std::fprintf(stderr, "%s\n", status.error().message.c_str());
  std::exit(1);
}

/// Somewhere over the model, from all of it to a close-up: the finest tiles fill the image.
Camera random_pose(const PatchModel& extent, std::mt19937& random) {
  const auto draw = [&random] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  const Bounds& box = extent.bounds;
  const glm::dvec3 size = box.max - box.min;
  const glm::dvec3 target =
      box.min + size * glm::dvec3(0.1 + 0.8 * draw(), 0.1 + 0.8 * draw(), 0.3 * draw());
  Orbit orbit;
  orbit.azimuth_degrees = 360.0 * draw();
  orbit.elevation_degrees = 8.0 + 60.0 * draw();
  orbit.distance_in_radii = std::pow(10.0, 0.4 - 2.0 * draw());
  return orbit_camera(target, extent.bounding_radius, orbit, 45.0, 1.6, extent.stance);
}

Camera between(const Camera& a, const Camera& b, double share) {
  const double s = share * share * (3.0 - 2.0 * share);
  Camera camera = b;
  camera.target = glm::mix(a.target, b.target, s);
  const glm::dvec3 from = a.eye - a.target;
  const glm::dvec3 to = b.eye - b.target;
  const double distance =
      std::exp(std::log(glm::length(from)) * (1.0 - s) + std::log(glm::length(to)) * s);
  glm::dvec3 way = glm::mix(glm::normalize(from), glm::normalize(to), s);
  if (glm::length(way) < 0.1) way = glm::normalize(to);
  camera.eye = camera.target + distance * glm::normalize(way);
  return camera;
}

struct Difference {
  std::size_t beyond_one = 0;
  int largest = 0;
  std::size_t holes = 0;  ///< covered in one alone
};

const std::vector<float>& values_of(const Image& image, const char* channel) {
  const Channel* const found = image.find(channel);
  if (found == nullptr) throw std::invalid_argument(std::string("an image without ") + channel);
  return found->values;
}

Difference difference(const Image& a, const Image& b) {
  const std::size_t pixels = std::size_t{a.width} * a.height;
  std::vector<int> worst(pixels, 0);
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>& of_a = values_of(a, name);
    const std::vector<float>& of_b = values_of(b, name);
    for (std::size_t p = 0; p < pixels; ++p) {
      worst[p] =
          std::max(worst[p], std::abs(srgb8_from_linear(of_a[p]) - srgb8_from_linear(of_b[p])));
    }
  }
  const std::vector<float>& alpha_of_a = values_of(a, "A");
  const std::vector<float>& alpha_of_b = values_of(b, "A");
  Difference found;
  for (std::size_t p = 0; p < pixels; ++p) {
    if (worst[p] > 1) ++found.beyond_one;
    found.largest = std::max(found.largest, worst[p]);
    if ((alpha_of_a[p] > 0.0F) != (alpha_of_b[p] > 0.0F)) ++found.holes;
  }
  return found;
}

class Flight {
 public:
  explicit Flight(const Arguments& arguments)
      : arguments_(arguments),
        context_(must(make_context(GlPlatform::Automatic, false))),
        load_([this](const char* name) { return context_->get_proc_address(name); }),
        opengl_(must(OpenGl::adopt(load_))),
        colour_(make_attachment(gl(), "picture", GL_RGBA16F, arguments.width, arguments.height)),
        framebuffer_(make_framebuffer(gl(), "picture", nullptr, {{0, &colour_}})) {
    SceneSettings settings;
    settings.size = ImageSize{arguments.width, arguments.height};
    plan_ = must(plan_scene(arguments.file, settings));
  }

  void fly() {
    const Clock::time_point start = Clock::now();
    source_ = must(TileSource::open(plan_));
    if (source_ == nullptr) must(Status(make_error("the file has no tiles")));
    const PatchModel& extent = source_->scene().patches;
    Camera camera = orbit_camera(0.5 * (extent.bounds.min + extent.bounds.max),
                                 extent.bounding_radius, {30.0, 25.0}, 45.0, 1.6, extent.stance);
    RenderSettings view = settings_at(camera);
    const StoreNeeds needs = pool_needs(extent, {&view, 1});
    stream_ = must(StreamedPatches::create(
        gl(), source_, needs, {arguments_.memory * 1'000'000U, arguments_.gpu * 1'000'000U},
        {&view, 1}, [] {}));
    viewport_ = must(Viewport::create(load_, extent, stream_->pool(), {&view, 1}));
    std::printf("opened after %.0f ms, %.0f MB\n", ms_since(start), resident_mb());
    draw(view, 1);
    std::printf("first picture after %.0f ms, %.0f MB\n", ms_since(start), resident_mb());
    picture("first");
    rest(view);
    std::printf("settled after %.0f ms, %.0f MB\n", ms_since(start), resident_mb());
    if (arguments_.stills <= arguments_.poses) {
      draw(view, arguments_.samples);
      picture("settled");
      compare(view, "settled");
    }
    std::mt19937 random(arguments_.seed);
    for (int pose = 1; pose <= arguments_.poses; ++pose) {
      const Camera next = random_pose(extent, random);
      move(camera, next);
      camera = next;
      view = settings_at(camera);
      const Clock::time_point rests = Clock::now();
      rest(view);
      const double settled = ms_since(rests);
      return_free_memory();  // as a window does at rest
      const StreamState state = stream_->state();
      std::printf(
          "pose %d: settled after %.0f ms, %zu tiles, %.1f M samples, %sGPU %.0f MB, "
          "cache %.0f MB, RSS %.0f MB, read %llu, from cache %llu\n",
          pose, settled, state.shown_tiles, 1e-6 * static_cast<double>(state.shown_samples),
          state.is_coarser ? "coarser, " : "", 1e-6 * static_cast<double>(state.gpu_bytes),
          1e-6 * static_cast<double>(state.cached_bytes), resident_mb(),
          static_cast<unsigned long long>(state.counts.read),
          static_cast<unsigned long long>(state.counts.cached));
      if (pose % arguments_.stills == 0) {
        draw(view, arguments_.samples);
        const std::string name = "pose" + std::to_string(pose);
        picture(name);
        if (!state.is_coarser) compare(view, name);
      }
      for (const std::string& failure : stream_->take_failures())
        std::printf("failure: %s\n", failure.c_str());
      std::fflush(stdout);
    }
    std::printf(
        "frames %zu: update mean %.1f ms, worst %.1f ms (%.1f of the thread's CPU time); "
        "draw mean %.1f, worst %.1f ms\n",
        frames_, update_sum_ / static_cast<double>(frames_), update_worst_, update_worst_cpu_,
        draw_sum_ / static_cast<double>(frames_), draw_worst_);
    std::printf("empty pictures %zu; peak %.0f MB\n", empty_, peak_mb());
  }

  /// What it takes to upload each view's tiles as one model.
  void fly_whole() {
    source_ = must(TileSource::open(plan_));
    const PatchModel& extent = source_->scene().patches;
    std::mt19937 random(arguments_.seed);
    for (int pose = 0; pose <= arguments_.poses; ++pose) {
      Camera camera = orbit_camera(0.5 * (extent.bounds.min + extent.bounds.max),
                                   extent.bounding_radius, {30.0, 25.0}, 45.0, 1.6, extent.stance);
      if (pose > 0) camera = random_pose(extent, random);
      const RenderSettings view = settings_at(camera);
      const Clock::time_point start = Clock::now();
      const LoadedScene scene = load(view);
      const double loaded = ms_since(start);
      const Clock::time_point uploads = Clock::now();
      const double cpu = thread_ms();
      viewport_ = must(Viewport::create(load_, RenderModel::of(scene.patches), {&view, 1}));
      gl().Finish();
      const double uploaded = ms_since(uploads);
      const double uploaded_cpu = thread_ms() - cpu;
      draw(view, 1);
      std::printf(
          "pose %d: %.1f M samples, read %.0f ms, uploaded %.0f ms (%.0f of the thread's "
          "CPU time), drawn %.0f ms\n",
          pose, 1e-6 * static_cast<double>(count_samples(scene.patches)), loaded, uploaded,
          uploaded_cpu, ms_since(uploads) - uploaded);
      std::fflush(stdout);
      viewport_.reset();
    }
  }

 private:
  const Gl& gl() const { return opengl_->gl(); }

  RenderSettings settings_at(const Camera& camera) {
    RenderSettings settings =
        must(render_settings_of(plan_, plan_.views.front(), source_->scene().patches));
    complete_look(plan_.views.front(), source_->scene(), settings);
    settings.camera = camera;
    settings.samples = arguments_.samples;
    return settings;
  }

  LoadedScene load(const RenderSettings& view) {
    Progress silent;
    const ViewsOf views = [&](const PatchModel&) -> Result<std::vector<RenderSettings>> {
      return std::vector{view};
    };
    return must(load_models(plan_.models, {}, {.patches = true}, silent, views));
  }

  void draw(RenderSettings view, int samples) {
    view.samples = samples;
    must(viewport_->draw(view, framebuffer_.id()));
    gl().Finish();
  }

  Image read() { return read_colour(gl(), colour_, arguments_.width, arguments_.height); }

  void picture(const std::string& name) {
    if (arguments_.pictures.empty()) return;
    must(write_png(arguments_.pictures / (name + ".png"), read()));
  }

  void update(const RenderSettings& view) {
    const Clock::time_point start = Clock::now();
    const double cpu = thread_ms();
    stream_->update({&view, 1}, 8.0);
    gl().Finish();
    const double ms = ms_since(start);
    update_worst_cpu_ = std::max(update_worst_cpu_, thread_ms() - cpu);
    update_sum_ += ms;
    update_worst_ = std::max(update_worst_, ms);
  }

  void move(const Camera& from, const Camera& to) {
    for (int frame = 1; frame <= arguments_.frames; ++frame) {
      RenderSettings view = settings_at(between(from, to, double(frame) / arguments_.frames));
      update(view);
      // As a window draws while something moves, at a coarse quality.
      RenderSettings coarse = view;
      coarse.pixels_per_sample = 8.0;
      const Clock::time_point start = Clock::now();
      draw(coarse, 1);
      const double ms = ms_since(start);
      draw_sum_ += ms;
      draw_worst_ = std::max(draw_worst_, ms);
      ++frames_;
      if (stream_->pool().store().instances.empty()) ++empty_;
    }
  }

  void rest(const RenderSettings& view) {
    update(view);
    ++frames_;
    while (!stream_->is_settled()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      update(view);
      ++frames_;
    }
  }

  void compare(const RenderSettings& view, const std::string& name) {
    const Image streamed = read();
    const LoadedScene scene = load(view);
    const auto viewport = must(Viewport::create(load_, RenderModel::of(scene.patches), {&view, 1}));
    must(viewport->draw(view, framebuffer_.id()));
    const Image reference = read();
    const Difference found = difference(streamed, reference);
    if (!arguments_.pictures.empty())
      must(write_png(arguments_.pictures / (name + "-reference.png"), reference));
    std::printf(
        "  %s: %zu pixels differ by more than one level, at most by %d; covered in one of "
        "the two alone: %zu\n",
        name.c_str(), found.beyond_one, found.largest, found.holes);
  }

  Arguments arguments_;
  std::unique_ptr<GlContext> context_;
  GlLoader load_;
  std::shared_ptr<const OpenGl> opengl_;
  Texture colour_;
  Framebuffer framebuffer_;
  ScenePlan plan_;
  std::shared_ptr<TileSource> source_;
  std::unique_ptr<StreamedPatches> stream_;
  std::unique_ptr<Viewport> viewport_;
  std::size_t frames_ = 0;
  double update_sum_ = 0.0;
  double update_worst_ = 0.0;
  double update_worst_cpu_ = 0.0;
  double draw_sum_ = 0.0;
  double draw_worst_ = 0.0;
  std::size_t empty_ = 0;
};

Arguments parse(int count, char** texts) {
  Arguments arguments;
  for (int k = 1; k < count; ++k) {
    const std::string text = texts[k];
    const auto next = [&] { return std::string(k + 1 < count ? texts[++k] : "0"); };
    if (text == "--poses")
      arguments.poses = std::stoi(next());
    else if (text == "--frames")
      arguments.frames = std::stoi(next());
    else if (text == "--seed")
      arguments.seed = static_cast<unsigned>(std::stoul(next()));
    else if (text == "--memory")
      arguments.memory = std::stoull(next());
    else if (text == "--gpu-memory")
      arguments.gpu = std::stoull(next());
    else if (text == "--samples")
      arguments.samples = std::stoi(next());
    else if (text == "--stills")
      arguments.stills = std::stoi(next());
    else if (text == "--pictures")
      arguments.pictures = next();
    else if (text == "--whole")
      arguments.whole = true;
    else if (text == "--size")
      std::sscanf(next().c_str(), "%ux%u", &arguments.width, &arguments.height);
    else
      arguments.file = text;
  }
  return arguments;
}

}  // namespace
}  // namespace relief

int main(int count, char** texts) {
  const relief::Arguments arguments = relief::parse(count, texts);
  relief::return_large_blocks();
  relief::Flight flight(arguments);
  if (arguments.whole)
    flight.fly_whole();
  else
    flight.fly();
}

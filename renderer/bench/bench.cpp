#include "renderer/bench/bench.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <utility>

#include "common/median.h"
#include "renderer/bench/cpu_rows.h"
#include "renderer/bench/mesh_pass.h"
#include "renderer/bench/shading_bound.h"
#include "renderer/engine_registry.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/gl/open_gl.h"
#include "renderer/gl/software.h"

namespace relief {
namespace {

/// What is drawn in each round.
struct Entry {
  GlFrame frame;
  std::unique_ptr<GlDrawing> drawing = {};
  std::vector<double> frame_ms = {};
  std::vector<double> gpu_ms = {};
  BenchRow result = {};
};

/// What decides which parts of a model an engine puts on the GPU.
struct Wanted {
  RenderModel model;
  std::string engine;
  StoreNeeds needs;
  double pixels_per_sample = 0.0;
  ClipRule clip = ClipRule::Off;

  bool operator==(const Wanted&) const = default;
};

Wanted wanted_by(const BenchMethod& row, const EngineEntry& engine) {
  Wanted wanted{
      row.model, engine.name, {}, pixels_per_sample_of(row.settings), row.settings.clip.rule};
  if (engine.features == nullptr) return wanted;
  const auto* const patches = row.model.find<PatchModel>();
  const ModelMaps maps = patches == nullptr ? ModelMaps(false) : ModelMaps(*patches);
  wanted.needs = needs_of(engine.features(row.settings, maps));
  return wanted;
}

/// A prepared model. Rows that need the same of a model share it. Others do not, so that nothing
/// else is on the GPU while they are timed.
struct Group {
  Wanted wanted;
  std::unique_ptr<GlPreparedModel> prepared;
};

/// Everything that a bench on OpenGL makes; what is drawn goes before what it is drawn of.
class Bench {
 public:
  Bench(const BenchJob& job, std::shared_ptr<const OpenGl> opengl)
      : job_(job), opengl_(std::move(opengl)) {}

  /// Draws every row, the bound and the mesh once.
  Status prepare(const Progress& progress) {
    for (const BenchMethod& row : job_.rows) {
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY_ASSIGN(auto engine, engine_for(row));
      RELIEF_TRY(add(*engine, row.settings));
    }
    return prepare_references();
  }

  void draw_round(bool timed) {
    for (const auto& entry : entries_) {
      const FrameTime time = time_frame(opengl_->gl(), entry->frame, *entry->drawing);
      if (!timed) continue;
      entry->frame_ms.push_back(time.wall_ms);
      if (time.gpu_ms) entry->gpu_ms.push_back(*time.gpu_ms);
    }
  }

  [[nodiscard]] BenchReport report() const {
    BenchReport report;
    report.renderer = renderer_name(opengl_->gl());
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      BenchRow row = entries_[k]->result;
      row.time.frames = static_cast<int>(entries_[k]->frame_ms.size());
      row.time.frame_ms = median_of(entries_[k]->frame_ms);
      if (!entries_[k]->gpu_ms.empty()) row.time.gpu_ms = median_of(entries_[k]->gpu_ms);
      if (k < job_.rows.size()) report.rows.push_back(row);
      if (k == bound_) report.shading_bound = row;
      if (k == mesh_) report.mesh = row;
    }
    return report;
  }

  [[nodiscard]] Status status() const {
    Status errors = check_errors(opengl_->gl(), "the bench");
    return errors ? opengl_->status() : errors;
  }

 private:
  Result<GlPreparedModel*> engine_for(const BenchMethod& row) {
    const RenderSettings& settings = row.settings;
    const EngineEntry* const engine = find_engine(settings.engine);
    assert(engine != nullptr && engine->capabilities.needs_opengl && "a row on OpenGL");
    Wanted wanted = wanted_by(row, *engine);
    for (const Group& group : groups_) {
      if (group.wanted == wanted) return group.prepared.get();
    }
    RELIEF_TRY_ASSIGN(auto made, engine->prepare({.model = row.model,
                                                  .views = {&settings, 1},
                                                  .opengl = opengl_,
                                                  .environments = environments_}));
    groups_.push_back({std::move(wanted), std::unique_ptr<GlPreparedModel>(
                                              static_cast<GlPreparedModel*>(made.release()))});
    return groups_.back().prepared.get();
  }

  Status prepare_references() {
    const std::size_t reference = job_.reference.value_or(0);
    const auto& [model, settings] = job_.rows[reference];
    const std::uint64_t pixels = entries_[reference]->result.covered_pixels;
    if (job_.reference && pixels > 0) {
      const auto* const patches = model.find<PatchModel>();
      assert(patches != nullptr && "the reference draws patches");
      RELIEF_TRY_ASSIGN(auto made,
                        bench_passes::prepare_shading_bound(opengl_, *patches, settings, pixels));
      references_.push_back(std::move(made));
      bound_ = entries_.size();
      RELIEF_TRY(add(*references_.back(), settings));
    }
    if (job_.mesh == nullptr) return {};
    RELIEF_TRY_ASSIGN(auto made, bench_passes::prepare_mesh(opengl_, *job_.mesh, settings));
    references_.push_back(std::move(made));
    mesh_ = entries_.size();
    return add(*references_.back(), settings);
  }

  /// Makes an image ready, draws it once, and keeps what its frame binds and shades.
  Status add(GlPreparedModel& engine, const RenderSettings& asked) {
    const Gl& gl = opengl_->gl();
    const RenderSettings settings = engine.settled(asked);
    RELIEF_TRY_ASSIGN(auto made, engine.model().make_frame(settings, whole_of(settings)));
    // Before what draws into it is made: the entry stays where it is.
    entries_.push_back(std::make_unique<Entry>(Entry{.frame = std::move(made)}));
    Entry& entry = *entries_.back();
    RELIEF_TRY_ASSIGN(entry.drawing, engine.make_drawing(entry.frame, settings, Counting::Off));
    (void)time_frame(gl, entry.frame, *entry.drawing);
    const BoundBytes bytes = bound_bytes(gl.recorder->explain());
    entry.result.gpu_bytes = bytes.all;
    entry.result.model_bytes = bytes.model;
    RenderResult read;
    read_frame(gl, entry.frame, settings.background.has_value(), read);
    entry.result.covered_pixels = read.covered_pixels;
    // Last, because a frame that is counted has holes.
    RELIEF_TRY_ASSIGN(const auto counting,
                      engine.make_drawing(entry.frame, settings, Counting::On));
    if (counting != nullptr) entry.result.fragments = count_fragments(gl, entry.frame, *counting);
    return status();
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const BenchJob& job_;
  std::shared_ptr<const OpenGl> opengl_;
  std::shared_ptr<EnvironmentCache> environments_ = std::make_shared<EnvironmentCache>();
  std::vector<Group> groups_;
  std::vector<std::unique_ptr<GlPreparedModel>> references_;
  std::vector<std::unique_ptr<Entry>> entries_;  ///< the rows, then what they are compared with
  std::size_t bound_ = kNone;
  std::size_t mesh_ = kNone;
};

/// A bench all of whose rows are on OpenGL.
Result<BenchReport> bench_on_opengl(const BenchJob& job, Progress& progress) {
  progress.begin_stage("prepare", 0);
  const RenderSettings& first = job.rows.front().settings;
  RELIEF_TRY_ASSIGN(auto opengl, OpenGl::create(first.platform, first.debug, true));
  Bench bench(job, std::move(opengl));
  RELIEF_TRY(bench.prepare(progress));
  progress.begin_stage(
      "frames", static_cast<std::uint64_t>(job.warm_up) + static_cast<std::uint64_t>(job.frames));
  for (int round = 0; round < job.warm_up + job.frames; ++round) {
    if (progress.cancelled()) return interrupted_error();
    bench.draw_round(round >= job.warm_up);
    progress.advance(1);
  }
  RELIEF_TRY(bench.status());
  return bench.report();
}

/// The rows on OpenGL, or those that are not, and where they are in the job.
struct Part {
  std::vector<BenchMethod> rows;
  std::vector<std::size_t> places;
};

Part part_of(const BenchJob& job, bool on_opengl) {
  Part part;
  for (std::size_t k = 0; k < job.rows.size(); ++k) {
    if (needs_opengl(job.rows[k].settings.engine) != on_opengl) continue;
    part.rows.push_back(job.rows[k]);
    part.places.push_back(k);
  }
  return part;
}

/// Puts the rows of a part in their places among all.
void place(const Part& part, std::vector<BenchRow> drawn, std::vector<BenchRow>& all) {
  for (std::size_t k = 0; k < drawn.size(); ++k) all[part.places[k]] = drawn[k];
}

}  // namespace

Result<BenchReport> bench(const BenchJob& job, Progress& progress) {
  assert(!job.rows.empty() && job.frames > 0);
  assert(!job.reference || needs_opengl(job.rows[*job.reference].settings.engine));
  const Part on_opengl = part_of(job, true);
  const Part on_cpu = part_of(job, false);
  BenchReport report;
  std::vector<BenchRow> rows(job.rows.size());
  if (on_opengl.rows.empty()) {
    report.renderer = "CPU";
  } else {
    BenchJob part{on_opengl.rows, job.mesh, {}, job.frames, job.warm_up};
    const auto& places = on_opengl.places;
    if (job.reference)
      part.reference = std::find(places.begin(), places.end(), *job.reference) - places.begin();
    RELIEF_TRY_ASSIGN(report, bench_on_opengl(part, progress));
    place(on_opengl, std::exchange(report.rows, {}), rows);
  }
  if (!on_cpu.rows.empty()) {
    RELIEF_TRY_ASSIGN(auto drawn, bench_passes::time_on_cpu(on_cpu.rows, job.frames, progress));
    place(on_cpu, std::move(drawn), rows);
  }
  report.rows = std::move(rows);
  return report;
}

}  // namespace relief

#include "renderer/costs/feature_costs.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/costs/removable_features.h"
#include "renderer/frame/features.h"

namespace relief {
namespace {

/// An image that is made ready, to be drawn any number of times.
class Scene {
 public:
  /// `left_out`: of the job's image. Copies the model only if a feature is one of its maps.
  static Result<std::unique_ptr<Scene>> create(const CostJob& job,
                                               std::span<const RemovableFeature* const> left_out) {
    std::unique_ptr<Scene> made(new Scene(job.settings));
    RenderSettings& settings = made->settings_;
    for (const RemovableFeature* const feature : left_out) {
      if (feature->leave_out != nullptr) feature->leave_out(settings);
      if (feature->leave_out_of == nullptr) continue;
      if (!made->own_) made->own_ = job.patches;
      feature->leave_out_of(*made->own_);
    }
    if (settings.eye_dome > 0.0) settings.outputs.depth = true;
    settings.frames = 1;  // after the one in which OpenGL takes memory for the targets
    const PatchModel& patches = made->own_ ? *made->own_ : job.patches;
    made->needs_ = needs_of(job.engine.features(settings, ModelMaps(patches)));
    made->model_ = RenderModel::of(patches);
    RELIEF_TRY_ASSIGN(made->prepared_, job.engine.prepare({.model = made->model_,
                                                           .views = {&settings, 1},
                                                           .opengl = job.opengl,
                                                           .environments = job.environments}));
    return made;
  }

  /// Draws the image; returns the time of a frame.
  Result<double> draw(Progress& progress) {
    if (progress.cancelled()) return interrupted_error();
    QuietProgress quiet(progress);
    RELIEF_TRY_ASSIGN(RenderResult drawn, prepared_->render(settings_, quiet));
    explanation_ = std::move(drawn.explanation);
    return drawn.frame_ms;
  }

  /// What the image that was drawn last took, but for its time.
  [[nodiscard]] FrameCost cost() const {
    FrameCost cost;
    cost.reads_normals = needs_.normals;
    cost.reads_colours = needs_.colours;
    if (!explanation_) return cost;
    cost.bytes = bound_bytes(*explanation_).all;
    cost.passes = explanation_->passes;
    for (const Explanation::Variant& variant : explanation_->variants)
      cost.lines += variant.drawn ? variant.lines : 0;
    return cost;
  }

 private:
  explicit Scene(RenderSettings settings) : settings_(std::move(settings)) {}

  RenderSettings settings_;
  std::optional<PatchModel> own_;
  RenderModel model_;
  StoreNeeds needs_;
  std::unique_ptr<PreparedModel> prepared_;  ///< after what it is made of
  std::optional<Explanation> explanation_;
};

/// The passes of one frame that another lacks, each as often as it does.
std::vector<std::string> passes_beyond(const std::vector<std::string>& some,
                                       std::vector<std::string> others) {
  std::vector<std::string> beyond;
  for (const std::string& pass : some) {
    const auto found = std::ranges::find(others, pass);
    if (found == others.end()) {
      beyond.push_back(pass);
    } else {
      others.erase(found);
    }
  }
  return beyond;
}

std::int64_t difference(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
}

/// Times of two images that were drawn in turns.
struct Turns {
  std::vector<double> whole;
  std::vector<double> without;
  std::vector<double> differences;
};

/// Draws each once to warm it up, then in turns. Which of the two is first changes, so that neither
/// profits from what the other leaves in caches.
Result<Turns> draw_in_turns(Scene& whole, Scene& without, int turns, Progress& progress) {
  RELIEF_TRY(whole.draw(progress));
  RELIEF_TRY(without.draw(progress));
  Turns times;
  for (int turn = 0; turn < turns; ++turn) {
    const bool is_whole_first = turn % 2 == 0;
    RELIEF_TRY_ASSIGN(const double first, (is_whole_first ? whole : without).draw(progress));
    RELIEF_TRY_ASSIGN(const double second, (is_whole_first ? without : whole).draw(progress));
    times.whole.push_back(is_whole_first ? first : second);
    times.without.push_back(is_whole_first ? second : first);
    times.differences.push_back(times.whole.back() - times.without.back());
    progress.advance(1);
  }
  return times;
}

double between_quartiles(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() * 3 / 4] - values[values.size() / 4];
}

FeatureCost cost_of(const RemovableFeature& feature, const Scene& whole, const Scene& without,
                    const Turns& times) {
  const FrameCost with_it = whole.cost();
  const FrameCost rest = without.cost();
  return {.feature = std::string(feature.name),
          .instead = std::string(feature.instead),
          .bytes = difference(with_it.bytes, rest.bytes),
          .passes = passes_beyond(with_it.passes, rest.passes),
          .saved_passes = passes_beyond(rest.passes, with_it.passes),
          .lines = difference(with_it.lines, rest.lines),
          .frame_ms = median_of(times.differences),
          .spread_ms = between_quartiles(times.differences),
          .reads_normals = with_it.reads_normals && !rest.reads_normals,
          .reads_colours = with_it.reads_colours && !rest.reads_colours};
}

std::vector<const RemovableFeature*> features_used(const CostJob& job) {
  std::vector<const RemovableFeature*> used;
  for (const RemovableFeature& feature : removable_features()) {
    if (feature.is_used(job.settings, job.patches)) used.push_back(&feature);
  }
  return used;
}

}  // namespace

bool can_measure_costs(const EngineEntry& engine) {
  return engine.capabilities.explanation && engine.features != nullptr &&
         engine.forms.front() == ModelForm::Patches;
}

Result<FeatureCosts> measure_feature_costs(const CostJob& job, Progress& progress) {
  const std::vector<const RemovableFeature*> used = features_used(job);
  progress.begin_stage("leaving out features", (used.size() + 1) * job.turns);
  RELIEF_TRY_ASSIGN(const auto whole, Scene::create(job, {}));
  FeatureCosts costs;
  costs.turns = job.turns;
  std::vector<double> whole_ms;
  for (const RemovableFeature* const feature : used) {
    RELIEF_TRY_ASSIGN(const auto without, Scene::create(job, {&feature, 1}));
    RELIEF_TRY_ASSIGN(const Turns times, draw_in_turns(*whole, *without, job.turns, progress));
    costs.features.push_back(cost_of(*feature, *whole, *without, times));
    whole_ms.insert(whole_ms.end(), times.whole.begin(), times.whole.end());
  }
  RELIEF_TRY_ASSIGN(const auto bare, Scene::create(job, used));
  RELIEF_TRY_ASSIGN(const Turns times, draw_in_turns(*whole, *bare, job.turns, progress));
  whole_ms.insert(whole_ms.end(), times.whole.begin(), times.whole.end());
  costs.whole = whole->cost();
  costs.whole.frame_ms = median_of(whole_ms);
  costs.rest = bare->cost();
  costs.rest.frame_ms = median_of(times.without);
  return costs;
}

}  // namespace relief

#include "cli/trade/trade.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "cli/trade/trade_search.h"

namespace relief::cli {
namespace {

/// Settings whose frames are drawn in turns: enough that few are spent on the default among them,
/// and few enough that the time is looked at now and then.
constexpr std::size_t kSettingsInTurns = 6;

/// Rows that are at most so far from the front are timed again: medians of five frames are off by
/// several per cent on a machine that does other work.
constexpr double kNearFront = 0.1;

/// The share of the time after which no more settings are begun: the rest is for times near the
/// front.
constexpr double kShareOfSearch = 0.8;

/// The time that a job may take, as a stage of its progress.
class TradeTime {
 public:
  TradeTime(double seconds, Progress& progress) : seconds_(seconds), progress_(progress) {
    progress_.begin_stage("settings", milliseconds(seconds));
  }

  [[nodiscard]] double passed() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] bool is_over() const { return passed() >= kShareOfSearch * seconds_; }

  void report() {
    const std::uint64_t now = milliseconds(std::min(passed(), seconds_));
    progress_.advance(now - reported_);
    reported_ = now;
  }

 private:
  static std::uint64_t milliseconds(double seconds) {
    return static_cast<std::uint64_t>(1e3 * seconds);
  }

  double seconds_;
  Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::uint64_t reported_ = 0;
};

/// Measures settings a few at a time until the time is over. Returns whether all were measured.
Result<bool> measure_all(const std::vector<TradeSetting>& settings, const TradeRounds& rounds,
                         std::set<TradeSetting>& tried, TradeBench& bench, TradeTime& time,
                         Progress& progress) {
  std::vector<TradeSetting> left;
  for (const TradeSetting& setting : settings) {
    if (tried.find(setting) == tried.end()) left.push_back(setting);
  }
  for (std::size_t first = 0; first < left.size(); first += kSettingsInTurns) {
    if (time.is_over()) return false;
    const std::size_t last = std::min(left.size(), first + kSettingsInTurns);
    const std::vector<TradeSetting> some(left.begin() + static_cast<std::ptrdiff_t>(first),
                                         left.begin() + static_cast<std::ptrdiff_t>(last));
    RELIEF_TRY(bench.measure(some, rounds, progress));
    tried.insert(some.begin(), some.end());
    time.report();
  }
  return true;
}

/// The default first, then the presets that differ from it.
std::vector<TradeSetting> first_settings(const std::vector<TradeKnob>& knobs) {
  std::vector<TradeSetting> settings{usual_setting(knobs)};
  for (const auto& known : kQualities) {
    TradeSetting preset = setting_of(knobs, preset_of(known.value));
    if (std::find(settings.begin(), settings.end(), preset) == settings.end())
      settings.push_back(std::move(preset));
  }
  return settings;
}

std::vector<TradeAnswer> answers_to(const std::vector<TradeQuestion>& questions,
                                    const std::vector<TradeRow>& rows) {
  std::vector<TradeAnswer> answers;
  for (const TradeQuestion& question : questions) {
    TradeAnswer found{question, answer(question, rows), {}};
    if (!found.row) found.why_not = why_not(question, rows);
    answers.push_back(std::move(found));
  }
  return answers;
}

}  // namespace

Result<TradeReport> measure_trade(const ScenePlan& plan, const TradeJob& job, GlPlatform platform,
                                  Progress& progress) {
  TradeTime time(job.seconds, progress);
  QuietProgress quiet(progress);
  const std::filesystem::path& scan = plan.models.front().file;
  RELIEF_TRY_ASSIGN(auto scene, read_trade_scene(scan, job.truth, quiet));
  RELIEF_TRY_ASSIGN(auto bench, TradeBench::prepare(scene, plan, platform, quiet));
  time.report();

  TradeReport report;
  std::set<TradeSetting> tried;
  const std::vector<TradeSetting> first = first_settings(scene.knobs);
  RELIEF_TRY(bench.measure(first, job.rounds, quiet));
  if (bench.rows().empty() || bench.rows().front().setting != first.front())
    return make_error("{}: can't be drawn with the default options", scan.string());
  tried.insert(first.begin(), first.end());
  time.report();

  const std::vector<TradeSetting> singles = single_changes(scene.knobs, first.front());
  report.single_changes = singles.size();
  RELIEF_TRY_ASSIGN(report.tried_single_changes,
                    measure_all(singles, job.rounds, tried, bench, time, quiet));
  while (!time.is_over() && !report.is_complete) {
    const std::vector<TradeSetting> next =
        next_settings(scene.knobs, bench.rows(), tried, kSettingsInTurns);
    report.is_complete = next.empty();
    RELIEF_TRY(measure_all(next, job.rounds, tried, bench, time, quiet));
  }
  RELIEF_TRY(bench.time_again(rows_near_front(bench.rows(), kNearFront), job.final_rounds, quiet));

  const RenderSettings& view = bench.view();
  report.scan = scan.string();
  report.renderer = bench.renderer();
  report.width = view.width;
  report.height = view.height;
  report.material = view.material;
  report.truth_is = scene.truth_is;
  report.truth = job.truth.string();
  report.truth_triangles = scene.truth.triangles.size();
  report.points = scene.files.points().size();
  report.knobs = scene.knobs;
  report.rows = bench.rows();
  report.answers = answers_to(job.questions, report.rows);
  report.seconds = time.passed();
  return report;
}

}  // namespace relief::cli

// Fronts, distances, answers and the choice of the next settings, on rows made by hand.
#include "cli/trade/trade_front.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "cli/trade/trade_answers.h"
#include "cli/trade/trade_knobs.h"
#include "cli/trade/trade_search.h"

namespace relief::test {
namespace {

using cli::TradeRow;

struct Made {
  double frame_ms;
  double psnr_db;
  std::uint64_t file_bytes = 1000;
  double surface_psnr_db = 80.0;
  double convert_seconds = 1.0;
};

TradeRow row_of(const Made& made) {
  TradeRow row;
  row.frame_ms = made.frame_ms;
  row.accuracy.psnr_db = made.psnr_db;
  row.file.file_bytes = made.file_bytes;
  row.file.surface_psnr_db = made.surface_psnr_db;
  row.file.convert_seconds = made.convert_seconds;
  return row;
}

std::vector<TradeRow> rows_of(const std::vector<Made>& all) {
  std::vector<TradeRow> rows;
  rows.reserve(all.size());
  for (const Made& made : all) rows.push_back(row_of(made));
  return rows;
}

const cli::TradePlane& picture_and_frame() {
  return cli::trade_planes().front();
}

TEST(TradeFront, HasTheRowsThatNoOtherBeats) {
  const auto rows = rows_of({{40, 45}, {10, 30}, {20, 40}, {25, 39}, {20, 38}});
  EXPECT_EQ(cli::front_of(rows, picture_and_frame()), (std::vector<std::size_t>{1, 2, 0}));
}

TEST(TradeFront, LeavesOutRowsThatWereNotMeasured) {
  auto rows = rows_of({{10, 30}, {5, 50}});
  rows[1].accuracy.psnr_db.reset();
  EXPECT_EQ(cli::front_of(rows, picture_and_frame()), (std::vector<std::size_t>{0}));
  EXPECT_FALSE(cli::distance_to_front(rows, 1, picture_and_frame()).has_value());
}

TEST(TradeFront, NormalsAreBetterTheLessTheyAreOff) {
  auto rows = rows_of({{10, 30, 1000}, {10, 30, 2000}, {10, 30, 3000}});
  rows[0].accuracy.normal_rms_deg = 3.0;
  rows[1].accuracy.normal_rms_deg = 1.0;
  rows[2].accuracy.normal_rms_deg = 2.0;
  for (const cli::TradePlane& plane : cli::trade_planes()) {
    if (std::string(plane.key) == "normals_file") {
      EXPECT_EQ(cli::front_of(rows, plane), (std::vector<std::size_t>{0, 1}));
    }
  }
}

// The nearest way to the front counts: 10 ms less of 100, or the error of 2 dB.
TEST(TradeFront, DistanceIsTheLeastImprovementThatIsNeeded) {
  const auto rows = rows_of({{100, 40}, {90, 40}, {100, 42}});
  // Doubles of 100 and 90: exact up to rounding.
  EXPECT_NEAR(*cli::distance_to_front(rows, 0, picture_and_frame()), 0.1, 1e-12);
  EXPECT_EQ(*cli::distance_to_front(rows, 1, picture_and_frame()), 0.0);
  EXPECT_EQ(*cli::distance_to_front(rows, 2, picture_and_frame()), 0.0);
}

TEST(TradeFront, AThirdQuantityCanPutARowOnTheFront) {
  const auto rows = rows_of({{100, 40, 500}, {50, 41, 1000}});
  EXPECT_GT(*cli::distance_to_front(rows, 0, picture_and_frame()), 0.1);
  EXPECT_EQ(*cli::distance_to_front(rows, 0, cli::judged_quantities()), 0.0);
}

TEST(TradeFront, EqualImagesAreOnTheFront) {
  const auto rows = rows_of({{100, std::numeric_limits<double>::infinity()}, {90, 60}});
  EXPECT_EQ(cli::front_of(rows, picture_and_frame()), (std::vector<std::size_t>{1, 0}));
}

cli::TradeQuestion question(const std::string& text) {
  auto parsed = cli::parse_question(text);
  EXPECT_TRUE(parsed) << text;
  return *parsed;
}

TEST(TradeAnswers, TakeTheBestRowWithinTheLimits) {
  const auto rows = rows_of({{40, 45, 900, 85, 9},
                             {10, 30, 500, 70, 2},
                             {20, 36, 700, 81, 3},
                             {29, 41, 800, 82, 4},
                             {30, 35, 600, 80, 1}});
  EXPECT_EQ(cli::answer(question("fastest at 35 dB"), rows), 2U);
  EXPECT_EQ(cli::answer(question("best under 30 ms"), rows), 3U);
  EXPECT_EQ(cli::answer(question("smallest at 80 dB"), rows), 4U);
  EXPECT_EQ(cli::answer(question("quickest at 81 dB"), rows), 2U);
  EXPECT_EQ(cli::answer(question("best under 30 ms under 0.75 kB"), rows), 2U);
}

TEST(TradeAnswers, SayWhatIsOutOfReach) {
  const auto rows = rows_of({{40, 33.25, 900, 85}, {10, 30, 500, 70}});
  const auto bright = question("fastest at 35 dB");
  EXPECT_FALSE(cli::answer(bright, rows).has_value());
  EXPECT_NE(cli::why_not(bright, rows).find("the most is 33.25, not 35"), std::string::npos);
  const auto quick = question("best under 5 ms");
  EXPECT_NE(cli::why_not(quick, rows).find("the least is 10, not 5"), std::string::npos);
  const auto both = question("best at 33 dB under 20 ms");
  EXPECT_NE(cli::why_not(both, rows).find("at once"), std::string::npos);
}

TEST(TradeAnswers, RefuseWhatIsNoQuestion) {
  for (const char* text : {"", "fastest", "nicest at 3 dB", "fastest at 35", "fastest at x dB",
                           "best under 30 dB", "best at 30 ms", "fastest at 35 dB under"}) {
    const auto parsed = cli::parse_question(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_NE(parsed.error().message.find("expected a goal and limits"), std::string::npos);
  }
}

TEST(TradeKnobs, EveryPresetIsASetting) {
  const auto knobs = cli::trade_knobs();
  std::set<cli::TradeSetting> settings;
  for (const auto& known : cli::kQualities) {
    const cli::QualityPreset preset = cli::preset_of(known.value);
    const cli::TradeSetting setting = cli::setting_of(knobs, preset);
    settings.insert(setting);
    // What the setting chooses is what the preset says, and all of it.
    const OptionValues file = cli::options_of(knobs, setting, cli::TradeStage::File);
    EXPECT_EQ(overlay_options(cli::options_of(knobs, setting, cli::TradeStage::Convert), file),
              preset.convert)
        << known.name;
    const OptionValues render = cli::options_of(knobs, setting, cli::TradeStage::Render);
    for (const auto& [key, value] : preset.render) {
      ASSERT_TRUE(render.find(key) != render.end()) << known.name << " " << key;
      EXPECT_EQ(render.at(key), value) << known.name << " " << key;
    }
  }
  EXPECT_EQ(settings.size(), cli::kQualities.size());
  EXPECT_EQ(settings.count(cli::usual_setting(knobs)), 1U) << "balanced is the default";
}

TEST(TradeKnobs, ChangesAreOfOneKnobAndPossible) {
  const auto knobs = cli::trade_knobs();
  const auto usual = cli::usual_setting(knobs);
  std::size_t choices = 0;
  for (const auto& knob : knobs) choices += knob.choices.size() - 1;
  const auto changes = cli::single_changes(knobs, usual);
  EXPECT_EQ(changes.size(), choices);
  std::set<std::string> names;
  for (const auto& setting : changes) names.insert(cli::name_of(knobs, setting));
  EXPECT_EQ(names.size(), changes.size()) << "a name for each";
  EXPECT_EQ(names.count("default"), 0U);
  EXPECT_EQ(cli::name_of(knobs, usual), "default");
  // With levels of detail no way to draw is left but those that have them.
  cli::TradeSetting levels = usual;
  for (const auto& setting : changes) {
    if (cli::name_of(knobs, setting) == "pixels-per-sample 8") levels = setting;
  }
  ASSERT_NE(levels, usual);
  for (const auto& setting : cli::single_changes(knobs, levels))
    EXPECT_EQ(cli::name_of(knobs, setting).find("multipass"), std::string::npos);
}

TEST(TradeKnobs, CommandsNameWhatDiffersFromTheDefaults) {
  const auto knobs = cli::trade_knobs();
  const auto draft = cli::setting_of(knobs, cli::preset_of(cli::Quality::Draft));
  const auto usual = cli::usual_setting(knobs);
  EXPECT_EQ(cli::convert_command(knobs, usual), "relief convert SCAN -o OUT.relief");
  EXPECT_EQ(cli::render_command(knobs, usual), "relief render OUT.relief -o OUT.png");
  EXPECT_NE(cli::convert_command(knobs, draft).find(" --codec compact"), std::string::npos);
  EXPECT_NE(cli::render_command(knobs, draft).find(" --samples 1"), std::string::npos);
  EXPECT_EQ(cli::render_command(knobs, draft).find("--engine"), std::string::npos);
}

TEST(TradeSearch, TriesNeighboursOfTheFrontUntilNoneIsLeft) {
  const auto knobs = cli::trade_knobs();
  std::vector<TradeRow> rows = rows_of({{10, 40, 1000, 80, 1}, {20, 30, 2000, 70, 2}});
  rows[0].setting = cli::usual_setting(knobs);
  rows[1].setting = cli::single_changes(knobs, rows[0].setting).front();  // behind all fronts
  std::set<cli::TradeSetting> tried{rows[0].setting, rows[1].setting};
  const auto steps = cli::steps_from(knobs, rows[0].setting);
  std::size_t found = 0;
  for (;;) {
    const auto next = cli::next_settings(knobs, rows, tried, 3);
    EXPECT_LE(next.size(), 3U);
    if (next.empty()) break;
    for (const auto& setting : next) {
      EXPECT_TRUE(tried.insert(setting).second) << "measured twice";
      EXPECT_NE(std::find(steps.begin(), steps.end(), setting), steps.end());
    }
    found += next.size();
  }
  EXPECT_EQ(found, steps.size() - 1) << "all but the one that had been tried";
}

TEST(TradeSearch, RowsNearTheFrontAreTimedAgain) {
  // 100 and 102 ms are as good as equal; 150 ms at a lower PSNR is far behind.
  auto rows = rows_of({{100, 40}, {102, 40}, {150, 38}, {900, 20}});
  EXPECT_EQ(cli::rows_near_front(rows, 0.1), (std::vector<std::size_t>{0, 1}));
  rows[3].quality = cli::Quality::Draft;
  EXPECT_EQ(cli::rows_near_front(rows, 0.1), (std::vector<std::size_t>{0, 1, 3}));
}

}  // namespace
}  // namespace relief::test

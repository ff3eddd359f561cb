// relief bench --trade, as a user runs it. No test looks at how long it took.
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/run_relief.h"

namespace relief::test {
namespace {

using nlohmann::json;

class TradeCommand : public CliTest {
 protected:
  /// The shortest run: the default and the presets, and a few more if the machine is quick.
  [[nodiscard]] std::vector<std::string> trade(const std::string& scan,
                                               const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"bench",    "--trade",         scan, "--size",   "40x32",
                                       "--json",   "--trade-seconds", "1",  "--frames", "1",
                                       "--report", path("page.html")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

json report_of(const Outcome& run) {
  EXPECT_EQ(run.exit_code, 0) << run.err;
  json parsed = json::parse(run.out, nullptr, false);
  EXPECT_TRUE(parsed.is_object()) << run.out;
  return parsed;
}

/// The text between two others.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before);
  if (from == std::string::npos) return {};
  const std::size_t start = from + before.size();
  return text.substr(start, text.find(after, start) - start);
}

TEST_F(TradeCommand, WritesAPageThatNeedsNothingElse) {
  const std::string scan = write_knot(3000);
  const json report = report_of(
      run_relief(trade(scan, {"--ask", "best under 1e9 ms", "--ask", "smallest at 500 dB"})));
  const std::string page = file_bytes(path("page.html"));
  EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U);
  for (const char* outside : {"http:", "https:", "src=", "@import", "url(", "<link"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  // The page's own copy of the report is the printed one.
  const json embedded = json::parse(between(page, R"(id="report">)", "</script>"), nullptr, false);
  EXPECT_EQ(embedded, report);

  const json& rows = report["rows"];
  ASSERT_GE(rows.size(), 3U);
  EXPECT_EQ(rows[0]["default"], true);
  std::set<std::string> presets;
  for (const json& row : rows) {
    if (row["quality"].is_string()) presets.insert(row["quality"]);
    EXPECT_GT(row["frame_ms"], 0.0);
    EXPECT_GT(row["file_bytes"], 0);
    EXPECT_GT(row["convert_seconds"], 0.0);
    EXPECT_GT(row["load_seconds"], 0.0);
    for (const char* key : {"psnr_db", "flip_mean", "normal_rms_deg", "holes", "gpu_bytes"})
      EXPECT_TRUE(row[key].is_number()) << key << " of " << row["name"];
    EXPECT_TRUE(row["distance_to_front"]["judged"].is_number());
  }
  EXPECT_EQ(presets, (std::set<std::string>{"draft", "balanced", "exact"}));
  for (const json& front : report["fronts"]) {
    EXPECT_FALSE(front["rows"].empty()) << front["front"];
    for (const json& row : front["rows"]) {
      EXPECT_EQ(
          rows[row.get<std::size_t>()]["distance_to_front"][front["front"].get<std::string>()],
          0.0);
    }
  }
  ASSERT_EQ(report["answers"].size(), 2U);
  const json& best = rows[report["answers"][0]["row"].get<std::size_t>()];
  for (const json& row : rows) EXPECT_GE(best["psnr_db"], row["psnr_db"]);
  EXPECT_TRUE(report["answers"][1]["row"].is_null());
  EXPECT_NE(report["answers"][1]["why_not"].get<std::string>().find("not 500"), std::string::npos);
  EXPECT_EQ(report["truth"], "finest patches");
  EXPECT_EQ(files(), (std::vector<std::string>{"knot.ply", "page.html"}));
}

TEST_F(TradeCommand, ComparesWithTheTruthThatIsNamed) {
  // The truth lies half a unit above the scanned square, so that nothing agrees with it but by
  // chance; compared with itself the square would have 40 dB and more.
  std::string points;
  for (int k = 0; k < 900; ++k)
    points += std::to_string(k % 30) + " " + std::to_string(k / 30) + " 0\n";
  const std::string scan = write("square.xyz", points);
  const std::string truth = write("truth.off", "OFF\n3 1 0\n0 0 20\n5 0 20\n0 5 20\n3 0 1 2\n");
  const json report = report_of(run_relief(trade(scan, {"--truth", truth})));
  EXPECT_EQ(report["truth"], "file");
  EXPECT_EQ(report["truth_triangles"], 1);
  EXPECT_LT(report["rows"][0]["psnr_db"], 25.0);
  expect_refused(trade(scan, {"--truth", scan}), "has no faces");
}

TEST_F(TradeCommand, RefusesWhatCantBeConvertedManyWays) {
  const std::string scan = write_knot(3000);
  ASSERT_EQ(run_relief({"convert", scan, "-o", path("knot.relief")}).exit_code, 0);
  expect_refused(trade(path("knot.relief")), "is a patch file; --trade converts");
  const std::string scene =
      write("scene.json", R"({"models": [{"file": "knot.ply"}], "views": [{"name": "a"}]})");
  expect_refused(trade(scene), "is a scene; --trade converts");
  const std::string volume =
      write("v.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: ascii\n\n7 ");
  expect_refused(trade(volume), "is a volume or 3D Gaussians; --trade converts");
  expect_refused(trade(path("missing.ply")), "missing.ply");
}

TEST_F(TradeCommand, RefusesWrongUsage) {
  const std::string scan = write_knot(100);
  const auto wrong = [&](const std::vector<std::string>& arguments, const std::string& about) {
    const Outcome run = run_relief(arguments);
    EXPECT_EQ(run.exit_code, 2) << run.err;
    EXPECT_NE(run.err.find(about), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  };
  wrong(trade(scan, {"--ask", "nicest at 3 dB"}), "expected a goal and limits");
  wrong(trade(scan, {"--sweep", "spacing=1"}), "--sweep");
  wrong({"bench", scan, "--ask", "fastest at 35 dB"}, "--trade");
  wrong({"bench", "--trade", scan, "--report", "page.svg"}, "expected a name that ends in .html");
}

TEST_F(TradeCommand, LeavesNothingWhenInterrupted) {
  const std::string scan = write_knot(30000);
  RunOptions options;
  options.interrupt_after = std::chrono::milliseconds(700);
  const Outcome run =
      run_relief({"bench", "--trade", scan, "--report", path("page.html")}, options);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("interrupted"), std::string::npos) << run.err;
  EXPECT_EQ(files(), (std::vector<std::string>{"knot.ply"}));
}

}  // namespace
}  // namespace relief::test

// How the command behaves towards who types: wrong words, closed streams, names of files, progress.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/console_progress.h"
#include "cli/usage.h"
#include "common/version.h"
#include "tests/cli/json_test.h"

namespace relief::test {
namespace {

using nlohmann::json;
using Manners = JsonTest;

/// Runs wrong usage; the one line that it prints.
std::string wrong_usage(const std::vector<std::string>& arguments) {
  const Outcome run = run_relief(arguments);
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("relief: ", 0), 0U) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  return run.err;
}

TEST(NearestWord, IsOneThatFewChangesMakeOfIt) {
  const std::vector<std::string> words{"convert", "compare", "render", "info"};
  EXPECT_EQ(cli::nearest_word("convrt", words), "convert");
  EXPECT_EQ(cli::nearest_word("ocnvert", words), "convert");  // two letters swapped are one change
  EXPECT_EQ(cli::nearest_word("compair", words), "compare");
  EXPECT_EQ(cli::nearest_word("inof", words), "info");
  EXPECT_EQ(cli::nearest_word("sparkle", words), "");
  EXPECT_EQ(cli::nearest_word("", words), "");
  EXPECT_EQ(cli::nearest_word("render", {}), "");
}

TEST(Words, TheWrongOneIsNamedWithTheNearest) {
  EXPECT_EQ(wrong_usage({"convert", "a.ply", "--ouput", "a.relief"}),
            "relief: convert: there is no option --ouput; did you mean --output? `relief convert "
            "--help` lists the options\n");
  EXPECT_EQ(wrong_usage({"convert", "a.ply", "--ouput=a.relief"}),
            "relief: convert: there is no option --ouput; did you mean --output? `relief convert "
            "--help` lists the options\n");
  EXPECT_EQ(
      wrong_usage({"convrt", "a.ply", "-o", "a.relief"}),
      "relief: there is no subcommand convrt; did you mean convert? `relief --help` lists the "
      "options\n");
  EXPECT_EQ(wrong_usage({"convert", "a.ply", "-o", "a.relief", "--sparkle"}),
            "relief: convert: there is no option --sparkle; `relief convert --help` lists the "
            "options\n");
  EXPECT_EQ(wrong_usage({"info", "a.relief", "b.relief"}),
            "relief: info: b.relief is one argument too many; `relief info --help` lists the "
            "options\n");
  EXPECT_EQ(wrong_usage({"convert", "a.ply"}),
            "relief: convert: --output is required; `relief convert --help` lists the options\n");
  EXPECT_NE(wrong_usage({}).find("a subcommand is required: "), std::string::npos);
  EXPECT_NE(wrong_usage({"help", "convrt"}).find("did you mean convert?"), std::string::npos);
}

TEST(Words, HelpAndVersionAreSubcommandsToo) {
  for (const std::string sub : {"bench", "compare", "convert", "export", "info", "render"}) {
    const Outcome word = run_relief({"help", sub});
    EXPECT_EQ(word.exit_code, 0) << word.err;
    EXPECT_EQ(word.out, run_relief({sub, "--help"}).out);
  }
  EXPECT_EQ(run_relief({"help"}).out, run_relief({"--help"}).out);
  const Outcome version = run_relief({"version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out, fmt::format("relief {}\n", kVersion));
}

TEST(Words, ValuesThatAreWrongComeInShortMessages) {
  for (const auto& wrong : std::vector<std::vector<std::string>>{
           {"convert", "a.ply", "-o", "a.relief", "--spacing", "nan"},
           {"convert", "a.ply", "-o", "a.relief", "--spacing", "inf"},
           {"convert", "a.ply", "-o", "a.relief", "--spacing", std::string(400, '9')},
           {"convert", "a.ply", "-o", "a.relief", "--codec", "tiny"},
           {"convert", "a.ply", "-o", "a.relief", "--memory", "1"},
           {"convert", "a.ply", "-o", "a.relief", "--" + std::string(400, 'x')},
           {"render", "a.obj", "-o", "a.png", "--texture", "t.png", "--points", "-1"},
           {"render", "a.obj", "-o", "a.png", "--texture", "t.png", "--points", "0"},
           {"render", "a.obj", "-o", "a.png", "--fov", "1e308"},
           {"render", "a.obj", "-o", "a.png", "--orthographic", "1e308"},
           {std::string(400, 'x')}}) {
    const std::string message = wrong_usage(wrong);
    EXPECT_LT(message.size(), 300U) << message;
  }
}

TEST_F(Manners, ConvertWritesOnlyFilesNamedRelief) {
  const std::string scan = write_knot(500);
  const std::string before = file_bytes(scan);
  for (const std::string name : {"other.ply", "knot", "knot.relief.gz", "folder"}) {
    EXPECT_NE(wrong_usage({"convert", scan, "-o", path(name)}).find(".relief"), std::string::npos);
  }
  EXPECT_EQ(file_bytes(scan), before);
  EXPECT_EQ(files(), std::vector<std::string>{"knot.ply"});
  EXPECT_EQ(run_relief({"convert", scan, "-o", path("a.RELIEF")}).exit_code, 0);
}

TEST_F(Manners, ASpacingWiderThanTheScanIsRefused) {
  const std::string scan = write_knot(2000);  // 10 across
  for (const std::string spacing : {"1e12", "1e100", "100"}) {
    expect_refused({"convert", scan, "-o", path("a.relief"), "--spacing", spacing},
                   "is more than the scan is wide");
  }
}

TEST_F(Manners, APatchFileIsNotConvertedAgain) {
  const std::string scan = write_knot(500);
  ASSERT_EQ(run_relief({"convert", scan, "-o", path("a.relief")}).exit_code, 0);
  const std::string about = "is a patch file already";
  expect_refused({"convert", path("a.relief"), "-o", path("b.relief")}, about);
  expect_refused({"convert", path("a.relief"), "-o", path("b.relief"), "--memory", "1G"}, about);
  // By its content, whatever it is named.
  expect_refused({"convert", write("a.ply", file_bytes(path("a.relief"))), "-o", path("b.relief")},
                 about);
}

/// What stands behind `name` in the text of `relief info`.
std::string line_of(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(fmt::format("  {:<12}", name), 0) == 0) return line.substr(14);
  }
  return {};
}

TEST_F(Manners, TextAndJsonOfInfoAgree) {
  ASSERT_EQ(run_relief({"convert", write_knot(3000), "-o", path("open.relief")}).exit_code, 0);
  // A ring is closed.
  std::string obj;
  constexpr int kSide = 8;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double u = 6.2831853 * (i % kSide) / kSide;
    const double v = 6.2831853 * (i / kSide) / kSide;  // NOLINT: rows
    obj += fmt::format("v {} {} {}\n", (2 + std::cos(v)) * std::cos(u),
                       (2 + std::cos(v)) * std::sin(u), std::sin(v));
  }
  const auto index = [](int i, int j) { return 1 + i % kSide + kSide * (j % kSide); };
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      obj += fmt::format("f {} {} {} {}\n", index(i, j), index(i + 1, j), index(i + 1, j + 1),
                         index(i, j + 1));
    }
  }
  ASSERT_EQ(run_relief({"convert", write("ring.obj", obj), "-o", path("ring.relief")}).exit_code,
            0);
  for (const auto& [name, closed] : {std::pair{"open.relief", false}, {"ring.relief", true}}) {
    const std::string text = run_relief({"info", path(name)}).out;
    const json info = run_json({"info", path(name)});
    EXPECT_EQ(line_of(text, "closed"), closed ? "yes" : "not known") << text;
    EXPECT_EQ(info["closed"], closed ? json(true) : json(nullptr));
    const auto box = [&](const char* low, const char* high) {
      const auto vector = [&](const json& v) {
        return fmt::format("{:.9g} {:.9g} {:.9g}", v[0].get<double>(), v[1].get<double>(),
                           v[2].get<double>());
      };
      return vector(info[low]) + " to " + vector(info[high]);
    };
    EXPECT_EQ(line_of(text, "bounds"), box("bounds_min", "bounds_max") + " of the input") << text;
    EXPECT_EQ(line_of(text, "drawn"), box("drawn_min", "drawn_max") + ", with margins") << text;
  }
}

TEST_F(Manners, DrawnBoundsHoldTheExportedSamples) {
  ASSERT_EQ(run_relief({"convert", write_knot(3000), "-o", path("a.relief")}).exit_code, 0);
  ASSERT_EQ(
      run_relief({"export", path("a.relief"), "-o", path("a.obj"), "--as", "points"}).exit_code, 0);
  const json info = run_json({"info", path("a.relief")});
  std::istringstream lines(file_bytes(path("a.obj")));
  std::size_t points = 0;
  const double step = info["spacing"].get<double>() / 100.0;  // an export rounds
  for (std::string word; lines >> word;) {
    if (word != "v") continue;
    ++points;
    for (int c = 0; c < 3; ++c) {
      double value = 0.0;
      lines >> value;
      EXPECT_GE(value, info["drawn_min"][c].get<double>() - step);
      EXPECT_LE(value, info["drawn_max"][c].get<double>() + step);
    }
  }
  EXPECT_EQ(points, info["samples"].get<std::size_t>());
}

TEST_F(Manners, AClosedStandardOutputIsNoFullDisk) {
  ASSERT_EQ(run_relief({"convert", write_knot(500), "-o", path("a.relief")}).exit_code, 0);
  RunOptions closed;
  closed.closed_out = true;
  expect_refused({"info", path("a.relief")}, "standard output is closed", closed);
  // No file that is opened meanwhile takes its place: the report would be written into it.
  const std::string scan = path("knot.ply");
  const std::string before = file_bytes(path("a.relief"));
  const Outcome run = run_relief({"convert", scan, "-o", path("a.relief")}, closed);
  EXPECT_EQ(run.err, "relief: standard output is closed; the result is not printed\n");
  EXPECT_EQ(file_bytes(path("a.relief")), before);
}

TEST_F(Manners, AReaderThatLeavesIsNoFailure) {
  RunOptions unread;
  unread.unread_out = true;
  const std::string scan = write_knot(500);
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {"convert", scan, "-o", path("a.relief")}, {"info", path("a.relief"), "--json"}}) {
    const Outcome run = run_relief(arguments, unread);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.err, "");
  }
}

TEST_F(Manners, ViewStandsForTheViewsOfASceneOnly) {
  const std::string scan = write_knot(500);
  EXPECT_NE(wrong_usage({"render", scan, "-o", path("{view}.png")}).find("{view} stands for"),
            std::string::npos);
  EXPECT_EQ(files(), std::vector<std::string>{"knot.ply"});
}

TEST(Progress, TextSaysHowFarAStageIs) {
  EXPECT_EQ(cli::progress_text({"neighbours", 0, 0, 20.0}), "neighbours, 20 s so far");
  EXPECT_EQ(cli::progress_text({"neighbours", 3, 0, 20.0}), "neighbours, 20 s so far");
  EXPECT_EQ(cli::progress_text({"merge", 0, 100, 75.0}), "merge, 1 min 15 s so far");
  EXPECT_EQ(cli::progress_text({"resample", 25, 100, 30.0}), "resample 25 %, 1 min 30 s left");
  EXPECT_EQ(cli::progress_text({"resample", 200, 100, 30.0}), "resample 100 %, 0 s left");
}

// A stage that never reports is the one that must not be silent.
TEST(Progress, LinesComeWhereNoBarCanBeDrawn) {
  testing::internal::CaptureStderr();
  {
    cli::ConsoleProgress progress(std::chrono::milliseconds(20));
    progress.begin_stage("neighbours", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    progress.finish();
  }
  std::istringstream lines(testing::internal::GetCapturedStderr());
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_EQ(line.rfind("relief: neighbours, ", 0), 0U) << line;
  EXPECT_GE(count, 2U);  // of 25, should the machine be busy
}

TEST_F(Manners, ADumbTerminalGetsNoControlCharacters) {
  RunOptions dumb;
  dumb.terminal = true;
  dumb.environment = {{"TERM", "dumb"}};
  const Outcome run = run_relief({"convert", write_knot(3000), "-o", path("a.relief")}, dumb);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err, "");
}

}  // namespace
}  // namespace relief::test
